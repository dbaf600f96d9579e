#include "optimize/old_stretch.h"

#include <algorithm>

#include "curve/polyline.h"

namespace clsurf {

std::size_t OldStretch::line_at(double after) const {
    return static_cast<std::size_t>(std::upper_bound(way.begin() + 1, way.end() - 1, after) - way.begin()) - 1;
}

Vec3 OldStretch::at(double after) const {
    const std::size_t line = line_at(after);
    const double length = way[line + 1] - way[line];
    return length > 0 ? Vec3(points[line] +
                             (points[line + 1] - points[line]) * std::clamp((after - way[line]) / length, 0.0, 1.0))
                      : points[line];
}

Vec3 OldStretch::nearest(const Vec3& p, double after) const {
    const std::size_t line = line_at(after);
    Vec3 nearest = nearest_on_line(p, points[line], points[line + 1]);
    const std::size_t first = line >= 2 ? line - 2 : 0, last = std::min(line + 3, points.size() - 1);
    for (std::size_t k = first; k < last; ++k) {
        const Vec3 q = nearest_on_line(p, points[k], points[k + 1]);
        if ((q - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = q;
    }
    return nearest;
}

}  // namespace clsurf
