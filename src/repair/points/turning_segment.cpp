#include "repair/points/turning_segment.h"

#include <algorithm>

namespace clsurf {
namespace {

/// How many millimetres a radian is drawn as: the tube for angles is then about as wide as those for points.
constexpr double lever = 30;
constexpr double tube_share = 0.5;  ///< of what lines may turn the axis by: the other half is that of chords

LineRules drawn_rules(const LineRules& rules) {
    LineRules drawn = rules;
    drawn.most = lever * rules.most_turned;
    drawn.radius = tube_share * drawn.most;
    return drawn;
}

double turn_lever(const OldStretch& old, const Orientation& orientation) {
    double most = 0;
    for (std::size_t k = 1; k < old.motion.size(); ++k)
        most = std::max(most, orientation.from_pole(orientation.angles(old.motion[k], 1)));
    return lever * most;
}

OldStretch drawn_angles(const OldStretch& old, const Orientation& orientation, double turn_lever) {
    OldStretch drawn = old;
    for (std::size_t k = 0; k < old.points.size(); ++k) {
        const RotaryAngles angles =
            k == 0 ? orientation.angles(old.motion[1], 0) : orientation.angles(old.motion[k], 1);
        drawn.points[k] = {lever * angles.tilt, turn_lever * angles.rotation, old.way[k]};
    }
    return drawn;
}

}  // namespace

TurningStretch::TurningStretch(const OldStretch& old, const Orientation& orientation,
                               const std::vector<StationOfPass>& stations, const LineRules& rules)
    : old_(old),
      orientation_(orientation),
      turn_lever_(turn_lever(old, orientation)),
      drawn_(drawn_angles(old, orientation, turn_lever_)),
      smooth_(drawn_, stations, drawn_rules(rules)) {}

RotaryAngles TurningStretch::at(double way) const {
    const std::size_t line = old_.line_at(way);
    const double length = old_.way[line + 1] - old_.way[line];
    const double part = length > 0 ? std::clamp((way - old_.way[line]) / length, 0.0, 1.0) : 0.0;
    return orientation_.angles(old_.motion[line + 1], part);
}

std::size_t TurningStretch::old_point(const NewPlace& place) const {
    const auto old = std::lower_bound(old_.way.begin() + 1, old_.way.end(), place.way);
    return old != old_.way.end() && *old == place.way ? static_cast<std::size_t>(old - old_.way.begin()) : 0;
}

RotaryAngles TurningStretch::angles(const NewPlace& place) const {
    if (const std::size_t k = old_point(place); k > 0) return orientation_.angles(old_.motion[k], 1);
    const Vec3 drawn = smooth_.at(old_.foot(place.position, place.way).way);
    return {drawn.x() / lever, drawn.y() / turn_lever_};
}

LineAngles TurningStretch::words(const NewPlace& place) const {
    const std::size_t k = old_point(place);
    const std::int64_t motion = old_.motion[k > 0 ? k : old_.line_at(place.way) + 1];
    return {orientation_.programmed(motion, angles(place)), k > 0 ? motion : -1};
}

AxisError TurningStretch::error_of(const NewPlace& from, const NewPlace& to) const {
    const ToolAxisPath line = orientation_.between(angles(from), angles(to));
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
