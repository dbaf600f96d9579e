#pragma once
// OldStretch: what the program has between two fixed points of a pass.

#include <cstdint>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

struct OldStretch {
    std::vector<Vec3> points;          ///< [mm] where lines end; the first is where the stretch begins
    std::vector<double> way;           ///< [mm] to each
    std::vector<std::int64_t> motion;  ///< that ends there

    [[nodiscard]] double length() const { return way.back(); }
    /// Where the lines are after some way [mm]; before and behind them, where they begin and end.
    [[nodiscard]] Vec3 at(double after) const;
    /// The line that lies there: it ends at the next point.
    [[nodiscard]] std::size_t line_at(double after) const;

    struct Foot {
        Vec3 position = Vec3::Zero();  ///< [mm]
        double way = 0;                ///< [mm]
    };
    /// The nearest place to `p` on the lines about `after` [mm] of way.
    [[nodiscard]] Foot foot(const Vec3& p, double after) const;
};

}  // namespace clsurf
