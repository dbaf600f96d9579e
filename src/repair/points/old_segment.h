#pragma once
// OldSegment: the section of the program between two fixed points of a pass.

#include <cstdint>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

struct OldSegment {
    std::vector<Vec3> points;          ///< [mm] ends of lines; the first is the beginning of the section
    std::vector<double> arc_length;    ///< [mm] arc length to each point
    std::vector<std::int64_t> motion;  ///< motion that ends at each point

    [[nodiscard]] double length() const { return arc_length.back(); }
    /// The position on the lines at an arc length [mm]; before and after them, their start and end.
    [[nodiscard]] Vec3 at(double after) const;
    /// The line at this place: it ends at the next point.
    [[nodiscard]] std::size_t line_at(double after) const;

    struct Projection {
        Vec3 position = Vec3::Zero();  ///< [mm]
        double arc_length = 0;         ///< [mm]
    };
    /// The place nearest to `p` on the lines around arc length `after` [mm].
    [[nodiscard]] Projection projection(const Vec3& p, double after) const;
};

}  // namespace clsurf
