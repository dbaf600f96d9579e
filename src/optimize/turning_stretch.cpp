#include "optimize/turning_stretch.h"

#include <algorithm>

namespace clsurf {

RotaryAngles TurningStretch::at(double way) const {
    const std::size_t line = old_.line_at(way);
    const double length = old_.way[line + 1] - old_.way[line];
    const double part = length > 0 ? std::clamp((way - old_.way[line]) / length, 0.0, 1.0) : 0.0;
    return orientation_.angles(old_.motion[line + 1], part);
}

RotaryAngles TurningStretch::beside(const NewPlace& place) const {
    return at(old_.foot(place.position, place.way).way);
}

LineAngles TurningStretch::words(const NewPlace& place) const {
    const auto old = std::lower_bound(old_.way.begin() + 1, old_.way.end(), place.way);
    if (old != old_.way.end() && *old == place.way) {
        const std::int64_t motion = old_.motion[static_cast<std::size_t>(old - old_.way.begin())];
        return {orientation_.programmed(motion, orientation_.angles(motion, 1)), motion};
    }
    return {orientation_.programmed(old_.motion[old_.line_at(place.way) + 1], beside(place)), -1};
}

AxisError TurningStretch::error_of(const NewPlace& from, const NewPlace& to) const {
    const ToolAxisPath line = orientation_.between(beside(from), beside(to));
    const auto error_at = [&](double way) {
        const double part = (way - from.way) / (to.way - from.way);
        return angle_between(orientation_.axis(line.at(part)), orientation_.axis(at(way)));
    };
    AxisError error;
    double greatest_of_points = -1, before = from.way;
    const auto look_between = [&](double way) {
        error.greatest = std::max(error.greatest, error_at(0.5 * (before + way)));
        before = way;
    };
    const auto first = std::upper_bound(old_.way.begin(), old_.way.end(), from.way) - old_.way.begin();
    for (auto i = static_cast<std::size_t>(first); i < old_.way.size() && old_.way[i] < to.way; ++i) {
        look_between(old_.way[i]);
        const double here = error_at(old_.way[i]);
        error.greatest = std::max(error.greatest, here);
        if (here > greatest_of_points) {
            greatest_of_points = here;
            error.point = i;
        }
    }
    look_between(to.way);
    return error;
}

}  // namespace clsurf
