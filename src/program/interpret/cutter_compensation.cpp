#include "program/interpret/cutter_compensation.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace clsurf {
namespace {

constexpr double pi = std::numbers::pi;
/// Flatter corners are passed without an arc or a retreat [rad], as in LinuxCNC.
constexpr double flat_corner = 0.05;
constexpr double no_length = 1e-9;        ///< [mm]
constexpr double angle_tolerance = 1e-9;  ///< [rad]

Vec2 left_of(const Vec2& v) { return {-v.y(), v.x()}; }
double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Angle of the path around `centre`, positive and at most a full circle [rad].
double sweep_of(const Vec2& begin, const Vec2& end, const Vec2& centre, bool counter_clockwise) {
    double sweep = angle_of(end - centre) - angle_of(begin - centre);
    if (!counter_clockwise) sweep = -sweep;
    while (sweep <= angle_tolerance) sweep += 2 * pi;
    while (sweep > 2 * pi + angle_tolerance) sweep -= 2 * pi;
    return sweep;
}

/// Intersections of a line and a circle: the parameters along the line, in ascending order.
std::optional<std::pair<double, double>> meets_circle(const Vec2& point, const Vec2& direction, const Vec2& centre,
                                                      double radius) {
    const double along = (centre - point).dot(direction);
    const double off = cross(direction, centre - point);
    const double half_squared = radius * radius - off * off;
    if (half_squared < 0) return std::nullopt;
    const double half = std::sqrt(half_squared);
    return std::pair{along - half, along + half};
}

constexpr const char* too_tight = "the tool does not fit into this inside corner";

}  // namespace

void CutterCompensation::start(bool left, double radius) {
    on_ = true;
    left_ = left != (radius < 0);
    radius_ = std::abs(radius);
    first_ = true;
    open_ = {};
}

void CutterCompensation::stop() {
    on_ = false;
    first_ = true;
    open_ = {};
}

Vec2 CutterCompensation::enter_at_offset(const Vec2& from, const Vec2& direction) {
    first_ = false;
    open_ = {};
    centre_ = from + side() * radius_ * left_of(direction);
    return centre_;
}

std::string CutterCompensation::finish() { return entered() ? check_reach(centre_) : std::string(); }

CompensatedStep CutterCompensation::line(const Vec2& from, const Vec2& to) {
    if (first_) return entry_line(from, to);
    CompensatedStep step;
    const Vec2 displacement = to - from;
    if (displacement.norm() == 0) {  // along the plane's normal only: it ends at the future corner
        step.moves.push_back({centre_});
        return step;
    }
    const Vec2 direction = displacement.normalized();
    const Vec2 off = side() * radius_ * left_of(direction);
    Open next;
    next.direction = direction;
    next.offset_begin = from + off;
    join(step, from, direction, next);
    if (!step.error.empty()) return step;
    step.moves.push_back({to + off});
    centre_ = to + off;
    open_ = next;
    return step;
}

CompensatedStep CutterCompensation::arc(const Vec2& from, const Vec2& to, const Vec2& centre, bool counter_clockwise) {
    if (first_) return entry_arc(from, to, centre, counter_clockwise);
    CompensatedStep step;
    // If the radius at the end differs from that at the start, LinuxCNC uses that at the end.
    const double programmed = (to - centre).norm();
    if (inside(counter_clockwise) && programmed < radius_ - no_length) {
        step.error = fmt::format("the tool (radius {:.4f} mm) does not fit into an arc of radius {:.4f} mm", radius_,
                                 programmed);
        return step;
    }
    const double grows = inside(counter_clockwise) ? -radius_ : radius_;
    Open next;
    next.is_arc = true;
    next.centre = centre;
    next.radius = programmed + grows;
    next.sweep = sweep_of(from, to, centre, counter_clockwise);
    next.counter_clockwise = counter_clockwise;
    const Vec2 outwards = (from - centre).normalized();
    const Vec2 tangent = counter_clockwise ? left_of(outwards) : Vec2(-left_of(outwards));
    next.offset_begin = from + grows * outwards;
    join(step, from, tangent, next);
    if (!step.error.empty()) return step;
    const Vec2 end = to + grows * (to - centre).normalized();
    step.moves.push_back({end, centre, true, counter_clockwise});
    centre_ = end;
    open_ = next;
    return step;
}

/// The tool's centre moves straight to the point next to the end of the first programmed motion.
CompensatedStep CutterCompensation::entry_line(const Vec2& from, const Vec2& to) {
    CompensatedStep step;
    const Vec2 displacement = to - from;
    if (displacement.norm() < radius_ - no_length) {
        step.error = fmt::format(
            "the entry move into cutter compensation ({:.4f} mm) must be longer than the tool's radius ({:.4f} mm)",
            displacement.norm(), radius_);
        return step;
    }
    const Vec2 off = side() * radius_ * left_of(displacement.normalized());
    // LinuxCNC checks the reach of the entry against its side, not along its path.
    open_ = {};
    open_.valid = true;
    open_.begin = from;
    open_.direction = off;
    centre_ = to + off;
    step.moves.push_back({centre_});
    first_ = false;
    return step;
}

/// An arc from the tool's centre to the point next to the programmed end, tangent there to the programmed arc.
CompensatedStep CutterCompensation::entry_arc(const Vec2& from, const Vec2& to, const Vec2& centre,
                                              bool counter_clockwise) {
    CompensatedStep step;
    if ((to - from).norm() < radius_ - no_length) {
        step.error = fmt::format(
            "the entry arc into cutter compensation must reach farther than the tool's radius ({:.4f} mm)", radius_);
        return step;
    }
    if (inside(counter_clockwise) && (to - centre).norm() < radius_ - no_length) {
        step.error = fmt::format("the tool (radius {:.4f} mm) does not fit into an arc of radius {:.4f} mm", radius_,
                                 (to - centre).norm());
        return step;
    }
    const Vec2 inwards = (centre - to).normalized();
    const Vec2 end = to + (inside(counter_clockwise) ? radius_ : -radius_) * inwards;
    // The centre is on the programmed radius through the end, equidistant from begin and end.
    const Vec2 chord = from - end;
    const double lean = chord.dot(inwards);
    if (std::abs(lean) < 1e-6 * chord.norm()) {
        step.error = "the entry arc into cutter compensation has no centre: it would be a straight line";
        return step;
    }
    const Vec2 middle = end + (chord.squaredNorm() / (2 * lean)) * inwards;
    open_ = {};
    open_.valid = true;
    open_.is_arc = true;
    open_.begin = from;
    open_.centre = middle;
    open_.radius = (end - middle).norm();
    open_.sweep = 2 * pi;  // LinuxCNC does not limit how far a corner cuts into an entry arc
    open_.counter_clockwise = counter_clockwise;
    centre_ = end;
    step.moves.push_back({end, middle, true, counter_clockwise});
    first_ = false;
    return step;
}

void CutterCompensation::join(CompensatedStep& step, const Vec2& corner, const Vec2& tangent, Open& next) {
    // The angle of the tool's centre about the corner to the side of the next motion: from −90° (backwards along its
    // path, inside) to 270°.
    double turn = angle_of(centre_ - corner) - angle_of(side() * left_of(tangent));
    turn *= side();
    while (turn < -0.5 * pi) turn += 2 * pi;
    while (turn >= 1.5 * pi) turn -= 2 * pi;
    next.valid = true;
    if (inside_corner(turn, next)) {
        if (!meet(corner, next, step)) {
            step.error = too_tight;
            return;
        }
        step.error = check_reach(step.corner);
        step.moves_corner = true;
        next.begin = step.corner;
        return;
    }
    if (turn <= flat_corner) {
        next.begin = centre_;
        return;
    }
    if (!next.is_arc) {
        step.error = check_reach(centre_);
        if (!step.error.empty()) return;
    }
    step.moves.push_back({next.offset_begin, corner, true, !left_});
    next.begin = next.offset_begin;
}

bool CutterCompensation::inside_corner(double angle, const Open& next) const {
    if (angle < -flat_corner || angle > pi + flat_corner) return true;
    // Backwards along its path, next to an arc that it went around: not around the corner's far side.
    if (angle <= pi - flat_corner) return false;
    return next.is_arc ? !inside(next.counter_clockwise) : open_.is_arc && !inside(open_.counter_clockwise);
}

/// Where the tool's centre passes from the open motion to the next: the intersection of their tracks.
bool CutterCompensation::meet(const Vec2& corner, const Open& next, CompensatedStep& step) const {
    if (open_.is_arc && next.is_arc) {
        const Vec2 between = next.centre - open_.centre;
        const double distance = between.norm();
        if (distance < no_length || open_.radius < no_length) return false;
        const double along =
            (open_.radius * open_.radius - next.radius * next.radius + distance * distance) / (2 * distance);
        const double height_squared = open_.radius * open_.radius - along * along;
        if (height_squared < 0) return false;
        const Vec2 unit = between / distance;
        // An inside corner has its centres on that side.
        const double where = side() * (open_.counter_clockwise == next.counter_clockwise ? 1.0 : -1.0);
        step.corner = open_.centre + along * unit + where * std::sqrt(height_squared) * left_of(unit);
        return true;
    }
    if (open_.is_arc) {
        const auto crossings = meets_circle(next.offset_begin, next.direction, open_.centre, open_.radius);
        if (!crossings) return false;
        // Inside a circle the line begins at its first intersection, outside at its last.
        step.corner = next.offset_begin +
                      (inside(open_.counter_clockwise) ? crossings->first : crossings->second) * next.direction;
        return true;
    }
    // The open motion's line passes through the tool's centre, perpendicular to the direction to the corner.
    const Vec2 direction = -side() * left_of((centre_ - corner).normalized());
    if (next.is_arc) {
        const auto crossings = meets_circle(centre_, direction, next.centre, next.radius);
        if (!crossings) return false;
        // From inside a circle the line ends at its last intersection, from outside at its first.
        step.corner = centre_ + (inside(next.counter_clockwise) ? crossings->second : crossings->first) * direction;
        return true;
    }
    const double across = cross(direction, next.direction);
    if (std::abs(across) < no_length) return false;
    step.corner = centre_ + cross(next.offset_begin - centre_, next.direction) / across * direction;
    return true;
}

/// Checks whether the open motion can end there without reversing.
std::string CutterCompensation::check_reach(const Vec2& end) const {
    if (!open_.valid) return {};
    if (open_.is_arc) {
        // At a flat corner it may have begun slightly early.
        const double left = sweep_of(open_.begin, end, open_.centre, open_.counter_clockwise);
        if (left > open_.sweep + flat_corner)
            return "an arc before an inside corner is too short: the tool would gouge";
        return {};
    }
    if ((end - open_.begin).dot(open_.direction) < 0)
        return "a line before an inside corner is too short: the tool would gouge";
    return {};
}

}  // namespace clsurf
