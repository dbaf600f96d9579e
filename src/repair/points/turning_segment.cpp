#include "repair/points/turning_segment.h"

#include <algorithm>

namespace clsurf {
namespace {

/// Millimetres per radian in `drawn_`: the tube for angles is then about as wide as that for points. 30 mm times most_turned
/// (0.01°) is 5.2 µm, about the usual tolerance of 5 µm.
constexpr double lever = 30;
constexpr double tube_share = 0.5;  ///< share of the tolerance of the axis; the other half is for chords

LineRules drawn_rules(const LineRules& rules) {
    LineRules drawn = rules;
    drawn.most = lever * rules.most_turned;
    drawn.radius = tube_share * drawn.most;
    return drawn;
}

double turn_lever(const OldSegment& old, const Orientation& orientation) {
    double most = 0;
    for (std::size_t k = 1; k < old.motion.size(); ++k)
        most = std::max(most, orientation.from_pole(orientation.angles(old.motion[k], 1)));
    return lever * most;
}

OldSegment drawn_angles(const OldSegment& old, const Orientation& orientation, double turn_lever) {
    OldSegment drawn = old;
    for (std::size_t k = 0; k < old.points.size(); ++k) {
        const RotaryAngles angles =
            k == 0 ? orientation.angles(old.motion[1], 0) : orientation.angles(old.motion[k], 1);
        drawn.points[k] = {lever * angles.tilt, turn_lever * angles.rotation, old.arc_length[k]};
    }
    return drawn;
}

}  // namespace

TurningSegment::TurningSegment(const OldSegment& old, const Orientation& orientation,
                               const std::vector<AlignedPoint>& aligned_points, const LineRules& rules)
    : old_(old),
      orientation_(orientation),
      turn_lever_(turn_lever(old, orientation)),
      drawn_(drawn_angles(old, orientation, turn_lever_)),
      smooth_(drawn_, aligned_points, drawn_rules(rules)) {}

RotaryAngles TurningSegment::at(double arc_length) const {
    const std::size_t line = old_.line_at(arc_length);
    const double length = old_.arc_length[line + 1] - old_.arc_length[line];
    const double part = length > 0 ? std::clamp((arc_length - old_.arc_length[line]) / length, 0.0, 1.0) : 0.0;
    return orientation_.angles(old_.motion[line + 1], part);
}

std::size_t TurningSegment::old_point(const NewPlace& place) const {
    const auto old = std::lower_bound(old_.arc_length.begin() + 1, old_.arc_length.end(), place.arc_length);
    return old != old_.arc_length.end() && *old == place.arc_length
               ? static_cast<std::size_t>(old - old_.arc_length.begin())
               : 0;
}

RotaryAngles TurningSegment::angles(const NewPlace& place) const {
    if (const std::size_t k = old_point(place); k > 0) return orientation_.angles(old_.motion[k], 1);
    const Vec3 drawn = smooth_.at(old_.projection(place.position, place.arc_length).arc_length);
    return {drawn.x() / lever, drawn.y() / turn_lever_};
}

LineAngles TurningSegment::words(const NewPlace& place) const {
    const std::size_t k = old_point(place);
    const std::int64_t motion = old_.motion[k > 0 ? k : old_.line_at(place.arc_length) + 1];
    return {orientation_.programmed(motion, angles(place)), k > 0 ? motion : -1};
}

AxisError TurningSegment::error_of(const NewPlace& from, const NewPlace& to) const {
    const ToolAxisPath line = orientation_.between(angles(from), angles(to));
    const auto error_at = [&](double arc_length) {
        const double part = (arc_length - from.arc_length) / (to.arc_length - from.arc_length);
        return angle_between(orientation_.axis(line.at(part)), orientation_.axis(at(arc_length)));
    };
    AxisError error;
    double greatest_of_points = -1, before = from.arc_length;
    const auto look_between = [&](double arc_length) {
        error.greatest = std::max(error.greatest, error_at(0.5 * (before + arc_length)));
        before = arc_length;
    };
    const auto first =
        std::upper_bound(old_.arc_length.begin(), old_.arc_length.end(), from.arc_length) - old_.arc_length.begin();
    for (auto i = static_cast<std::size_t>(first); i < old_.arc_length.size() && old_.arc_length[i] < to.arc_length;
         ++i) {
        look_between(old_.arc_length[i]);
        const double here = error_at(old_.arc_length[i]);
        error.greatest = std::max(error.greatest, here);
        if (here > greatest_of_points) {
            greatest_of_points = here;
            error.point = i;
        }
    }
    look_between(to.arc_length);
    return error;
}

}  // namespace clsurf
