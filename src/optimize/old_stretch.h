#pragma once
// OldStretch: what the program has between two fixed points of a pass.

#include <vector>

#include "core/geometry.h"

namespace clsurf {

struct OldStretch {
    std::vector<Vec3> points;  ///< [mm] where lines end; the first is where the stretch begins
    std::vector<double> way;   ///< [mm] to each

    [[nodiscard]] double length() const { return way.back(); }
    /// Where the lines are after some way [mm]; before and behind them, where they begin and end.
    [[nodiscard]] Vec3 at(double after) const;
    /// The nearest place to `p` on the lines about `after` [mm] of way.
    [[nodiscard]] Vec3 nearest(const Vec3& p, double after) const;

private:
    [[nodiscard]] std::size_t line_at(double after) const;
};

}  // namespace clsurf
