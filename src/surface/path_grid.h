#pragma once
// PathGrid: sparse points of the cutting passes by cell, to find a nearby part of the path. Used only if a search
// along the adjacent pass begins or is lost.

#include <cstdint>
#include <vector>

#include "core/cell_grid.h"
#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class PathGrid {
public:
    /// One entry per `cell` [mm] of arc length of every cut pass. O(points).
    PathGrid(const Positions& positions, const Passes& passes, const ArcLength& arc_length, double cell);

    struct Entry {
        PointIndex point = 0;
        std::int32_t pass = 0;  ///< index into passes
    };

    /// Calls f(entry) for every entry in the 27 cells around a position.
    template <typename F>
    void for_each_near(const Eigen::Vector3f& p, F&& f) const {
        grid_.for_each_near(p.cast<double>(), [&](CellGrid::Key cell) {
            const std::size_t slot = cell * hash_factor >> shift_;
            for (std::uint32_t k = slot_start_[slot]; k < slot_start_[slot + 1]; ++k) {
                if (cells_[k] == cell) f(entries_[k]);
            }
        });
    }

private:
    // 2^64 divided by the golden ratio, which spreads consecutive cells over the slots.
    static constexpr std::uint64_t hash_factor = 0x9e3779b97f4a7c15ull;

    CellGrid grid_;
    unsigned shift_ = 63;
    Column<std::uint32_t> slot_start_;
    Column<CellGrid::Key> cells_;  ///< cell of each entry, entries sorted by slot
    Column<Entry> entries_;
};

}  // namespace clsurf
