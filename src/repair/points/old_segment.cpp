#include "repair/points/old_segment.h"

#include <algorithm>

#include "numeric/polyline.h"

namespace clsurf {

std::size_t OldSegment::line_at(double after) const {
    return static_cast<std::size_t>(std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, after) -
                                    arc_length.begin()) -
           1;
}

Vec3 OldSegment::at(double after) const {
    const std::size_t line = line_at(after);
    const double length = arc_length[line + 1] - arc_length[line];
    return length > 0 ? Vec3(points[line] + (points[line + 1] - points[line]) *
                                                std::clamp((after - arc_length[line]) / length, 0.0, 1.0))
                      : points[line];
}

OldSegment::Projection OldSegment::projection(const Vec3& p, double after) const {
    std::size_t on = line_at(after);
    Vec3 nearest = nearest_on_line(p, points[on], points[on + 1]);
    const std::size_t first = on >= 2 ? on - 2 : 0, last = std::min(on + 3, points.size() - 1);
    for (std::size_t k = first; k < last; ++k) {
        const Vec3 q = nearest_on_line(p, points[k], points[k + 1]);
        if ((q - p).squaredNorm() < (nearest - p).squaredNorm()) {
            nearest = q;
            on = k;
        }
    }
    return {nearest, arc_length[on] + (nearest - points[on]).norm()};
}

}  // namespace clsurf
