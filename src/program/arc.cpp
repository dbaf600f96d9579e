#include "program/arc.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace clsurf {
namespace {

// Radii may differ by this much whatever the radius, by the relative part at most, and never by more
// than the last [mm].
constexpr double radius_play = 0.005;
constexpr double relative_play = 0.001;
constexpr double most_play = 0.5;
constexpr double same_point = 1e-9;  ///< [mm]

}  // namespace

Arc resolve_arc(const ArcWords& words, std::string& error) {
    const int u = (words.axis + 1) % 3;
    const int v = (words.axis + 2) % 3;
    Arc arc;
    arc.axis = static_cast<std::uint8_t>(words.axis);
    arc.turns = words.turns;
    const Vec2 from(words.begin[u], words.begin[v]);
    const Vec2 to(words.end[u], words.end[v]);
    Vec2 centre;
    if (words.has_radius) {
        const Vec2 chord = to - from;
        const double half = 0.5 * chord.norm();
        const double radius = std::abs(words.radius);
        if (half < same_point) {
            error = "an arc by radius cannot end where it starts: a full circle needs its centre";
            return arc;
        }
        if (half - radius > std::max(radius_play, relative_play * radius)) {
            error =
                fmt::format("arc radius {:.4f} is too small: the end is {:.4f} away from the start", radius, 2 * half);
            return arc;
        }
        const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
        // Left of the chord for a short counter-clockwise arc.
        const double sign = (words.clockwise ? -1.0 : 1.0) * (words.radius < 0 ? -1.0 : 1.0);
        const Vec2 left(-chord.y() / (2 * half), chord.x() / (2 * half));
        centre = 0.5 * (from + to) + sign * height * left;
    } else {
        centre = Vec2(words.centre[u], words.centre[v]);
        const double at_start = (from - centre).norm();
        const double at_end = (to - centre).norm();
        const double difference = std::abs(at_start - at_end);
        const bool wrong = difference > most_play ||
                           (difference > radius_play && difference > relative_play * std::max(at_start, at_end));
        if (wrong) {
            error = fmt::format("arc radius differs: {:.4f} at the start, {:.4f} at the end", at_start, at_end);
            return arc;
        }
        if (at_start < same_point) {
            error = "arc of radius zero";
            return arc;
        }
    }
    Vec3 at = words.begin;
    at[u] = centre.x();
    at[v] = centre.y();
    arc.centre = Xyz(at);
    return arc;
}

double arc_length(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end) {
    const int u = (arc.axis + 1) % 3;
    const int v = (arc.axis + 2) % 3;
    const Vec3 centre = arc.centre.vec();
    const Vec2 from(begin[u] - centre[u], begin[v] - centre[v]);
    const Vec2 to(end[u] - centre[u], end[v] - centre[v]);
    constexpr double two_pi = 2 * std::numbers::pi;
    double sweep = angle_of(to) - angle_of(from);
    if (clockwise) sweep = -sweep;
    while (sweep <= 1e-9) sweep += two_pi;
    sweep += two_pi * (arc.turns - 1);
    return std::hypot(0.5 * (from.norm() + to.norm()) * sweep, end[arc.axis] - begin[arc.axis]);
}

}  // namespace clsurf
