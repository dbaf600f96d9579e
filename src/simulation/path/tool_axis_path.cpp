#include "simulation/path/tool_axis_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clsurf {
namespace {

constexpr double least_angle = 1e-9;  ///< [rad] a smaller turn of the axis counts as none
constexpr double opposite = 1e-6;     ///< [rad] this close to half a turn the plane is not defined
constexpr int judged_places = 200;    ///< places of a passage over the other branch

/// Rotation along a great circle whose least distance from the pole is `tilt`, counted from the nearest point.
double rotation_at(double s, double tilt) { return std::atan2(std::sin(s), std::cos(s) * std::sin(tilt)); }
double rotation_slope(double s, double tilt) {
    const double sine = std::sin(tilt) * std::cos(s);
    return std::sin(tilt) / (sine * sine + std::sin(s) * std::sin(s));
}

PoleWindow window_of(double half, double tilt) {
    const double value = rotation_at(half, tilt);
    const double slope = rotation_slope(half, tilt);
    PoleWindow window;
    window.half = half;
    window.slope = (3 * value / half - slope) / 2;
    window.cubic = (slope - value / half) / (2 * half * half);
    window.greatest_speed = std::max(window.slope, slope);
    window.greatest_bend = std::abs(6 * window.cubic * half);
    return window;
}

double sign_of(double value) { return value < 0 ? -1.0 : 1.0; }

}  // namespace

PoleWindow pole_window(double least_tilt, double ratio) {
    if (1 / std::sin(least_tilt) <= ratio) return {};
    double low = 0;
    double high = 0.5 * std::numbers::pi;
    if (window_of(high, least_tilt).greatest_speed > ratio) return window_of(high, least_tilt);
    // 2^-60 of a quarter turn is less than the rounding of doubles.
    constexpr int halvings = 60;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (window_of(middle, least_tilt).greatest_speed > ratio ? low : high) = middle;
    }
    return window_of(high, least_tilt);
}

Vec3 great_circle(const Vec3& a, const Vec3& b, double part) {
    const double angle = angle_between(a, b);
    if (angle < least_angle) return a;
    return ((std::sin((1 - part) * angle) * a + std::sin(part * angle) * b) / std::sin(angle)).normalized();
}

ToolAxisPath::ToolAxisPath(const Kinematics& kinematics, const RotaryAngles& from, const RotaryAngles& to,
                           const AngleRange& tilt, double ratio, double tolerance)
    : kinematics_(&kinematics),
      from_(from),
      to_(to),
      begin_(kinematics.axis_of(from)),
      end_(kinematics.axis_of(to)),
      angle_(angle_between(begin_, end_)) {
    const bool turns = angle_ > least_angle && angle_ < std::numbers::pi - opposite;
    if (kinematics.interpolation == ToolAxisInterpolation::linear || !turns) return;
    // From the pole, every great circle begins at its own rotation: the rotation is interpolated linearly instead.
    if (std::abs(from.tilt) <= least_angle) return;
    mode_ = Mode::great_circle;
    branch_ = sign_of(from.tilt);
    if (kinematics.interpolation != ToolAxisInterpolation::safe) return;
    // Windows need axes at right angles, and the tool parallel to the axis of rotation at tilt 0.
    const Vec3& pole = kinematics.rotation.direction;
    const bool square = std::abs(kinematics.tilt.direction.dot(pole)) < least_angle &&
                        kinematics.tool_axis.cross(pole).norm() < least_angle;
    if (!square) return;
    const Vec3 normal = begin_.cross(end_).normalized();
    const double least = std::asin(std::min(1.0, std::abs(normal.dot(pole))));
    const Vec3 place = pole - normal.dot(pole) * normal;
    nearest_ = std::atan2(place.dot(normal.cross(begin_)), place.dot(begin_));
    const bool passes = nearest_ > 0 && nearest_ < angle_;
    if (!passes || std::sin(least) * ratio >= 1) return;
    // To the other side, if the tilt permits it and the axis deviates little enough.
    const RotarySolutions solutions = solve_rotary(kinematics, end_, from);
    for (int i = 0; i < solutions.count; ++i) {
        RotaryAngles other = solutions.angles[static_cast<std::size_t>(i)];
        if (sign_of(other.tilt) == branch_ || !tilt.contains(other.tilt)) continue;
        other.rotation += 2 * std::numbers::pi * std::round((from.rotation - other.rotation) / (2 * std::numbers::pi));
        ToolAxisPath over = *this;
        over.mode_ = Mode::linear;
        over.to_ = other;
        if (over.greatest_error(judged_places) > tolerance) continue;
        *this = over;
        return;
    }
    if (!(least > 0)) return;
    window_ = pole_window(least, ratio);
    if (!(window_.half > 0)) return;
    mode_ = Mode::window;
    turning_ = sign_of(normal.dot(pole));
    centre_ = on_great_circle(great_circle(begin_, end_, nearest_ / angle_)).rotation;
}

RotaryAngles ToolAxisPath::on_great_circle(const Vec3& axis) const {
    const RotarySolutions solutions = solve_rotary(*kinematics_, axis, from_);
    RotaryAngles found = solutions.angles[0];
    if (solutions.count == 2 && sign_of(found.tilt) != branch_) found = solutions.angles[1];
    // A great circle turns about the pole by less than half a turn.
    found.rotation = from_.rotation + std::remainder(found.rotation - from_.rotation, 2 * std::numbers::pi);
    found.tilt = from_.tilt + std::remainder(found.tilt - from_.tilt, 2 * std::numbers::pi);
    return found;
}

RotaryAngles ToolAxisPath::at(double part) const {
    if (mode_ == Mode::linear)
        return {from_.tilt + part * (to_.tilt - from_.tilt), from_.rotation + part * (to_.rotation - from_.rotation)};
    if (part <= 0) return from_;
    RotaryAngles angles = on_great_circle(great_circle(begin_, end_, part));
    const double s = part * angle_ - nearest_;
    if (mode_ == Mode::window && std::abs(s) < window_.half)
        angles.rotation = centre_ + turning_ * (window_.slope * s + window_.cubic * s * s * s);
    return angles;
}

double ToolAxisPath::greatest_error(int samples) const {
    double greatest = 0;
    for (int i = 0; i <= samples; ++i) {
        const double part = static_cast<double>(i) / samples;
        greatest = std::max(greatest, angle_between(kinematics_->axis_of(at(part)), great_circle(begin_, end_, part)));
    }
    return greatest;
}

}  // namespace clsurf
