#pragma once
// Sites: the places of a log at which passes are compared. They depend on position, not on time: a site is a place where the
// path crosses one of a set of planes that are fixed in the workpiece. A second log of the same path has the same sites, so the
// same place is judged alike, and the sites of adjacent passes are next to each other.

#include <bit>
#include <cstdint>
#include <vector>

#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

class Sites {
public:
    /// A site is the first point of a cut pass after a plane normal to the axis along which the tool moves fastest there. The
    /// planes are 0.2 mm apart, below 35 mm/s half of that, below 18 mm/s a quarter, and so on, but at least a tenth of a
    /// step-over. O(points), parallel. For signals that are derived when they are read: O(1), and each block of points when it
    /// is requested.
    Sites(const ClSurface& surface, const Signals& signals);

    [[nodiscard]] bool at(PointIndex point) const {
        fill_.need(point);
        return (words_[static_cast<std::size_t>(point / 64)] >> (point % 64) & 1) != 0;
    }
    /// Where the path crosses the plane of a site. Domain: at(site).
    [[nodiscard]] PathLocation place(PointIndex site) const;
    /// The site nearest to a point; −1: there is none nearby.
    [[nodiscard]] PointIndex nearest(PointIndex point) const;
    /// Calls f(site) for the sites from `first` to `last`, `last` exclusive, in order.
    template <typename F>
    void for_each(PointIndex first, PointIndex last, F&& f) const {
        if (first >= last) return;
        fill_.need(first, last - 1);
        for (PointIndex word = first / 64; word * 64 < last; ++word) {
            for (std::uint64_t left = words_[static_cast<std::size_t>(word)]; left != 0; left &= left - 1) {
                const PointIndex site = word * 64 + std::countr_zero(left);
                if (site >= first && site < last) f(site);
            }
        }
    }

private:
    struct Crossing {
        bool crosses = false;
        float fraction = 0;  ///< fraction of the step from the point before
    };
    [[nodiscard]] Crossing crossing(PointIndex point) const;
    static Crossing crossing(const ClSurface& surface, const Signals& signals, int most_halvings, PointIndex point);

    const ClSurface& surface_;
    const Signals& signals_;
    int most_halvings_;
    Column<std::uint64_t> words_;  ///< one bit per point
    BlockFillPointer fill_;
};

}  // namespace clsurf
