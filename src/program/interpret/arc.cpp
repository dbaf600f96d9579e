#include "program/interpret/arc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "core/units.h"

namespace clsurf {
namespace {

constexpr double same_point = 1e-9;  ///< [mm]
constexpr double most_chords = 100'000;
/// Siemens, alarm 14040: the centre may be rotated about the start by √0.001 [rad].
constexpr double most_turn_of_centre = 0.0316227766;

/// The centre of the circle of the start's radius through both ends, on the side of the programmed one.
Vec2 centre_on_bisector(const Vec2& from, const Vec2& to, const Vec2& programmed) {
    const Vec2 chord = to - from;
    const double half = 0.5 * chord.norm();
    if (half < same_point) return programmed;
    const double radius = (programmed - from).norm();
    const Vec2 left(-chord.y() / (2 * half), chord.x() / (2 * half));
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
    const Vec2 middle = 0.5 * (from + to);
    return middle + std::copysign(height, (programmed - middle).dot(left)) * left;
}

}  // namespace

Arc resolve_arc(const ArcWords& words, const ArcTolerance& tolerance, std::string& error) {
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
        if (half - radius > std::max(tolerance.reach, tolerance.relative_reach * radius)) {
            error =
                fmt::format("arc radius {:.4f} is too small: the end is {:.4f} away from the start", radius, 2 * half);
            return arc;
        }
        const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
        // To the left of the chord for a counter-clockwise arc of less than 180°.
        const double sign = (words.clockwise ? -1.0 : 1.0) * (words.radius < 0 ? -1.0 : 1.0);
        const Vec2 left(-chord.y() / (2 * half), chord.x() / (2 * half));
        centre = 0.5 * (from + to) + sign * height * left;
    } else {
        centre = Vec2(words.centre[u], words.centre[v]);
        const double at_start = (from - centre).norm();
        const double at_end = (to - centre).norm();
        const double difference = std::abs(at_start - at_end);
        const bool wrong =
            difference > tolerance.most ||
            (difference > tolerance.absolute && difference > tolerance.relative * std::max(at_start, at_end));
        if (wrong) {
            error = fmt::format("arc radius differs: {:.4f} at the start, {:.4f} at the end", at_start, at_end);
            return arc;
        }
        if (at_start < same_point) {
            error = "arc of radius zero";
            return arc;
        }
        if (tolerance.moves_centre) {
            const Vec2 programmed = centre;
            centre = centre_on_bisector(from, to, programmed);
            const double moved = (centre - programmed).norm();
            if (moved > most_turn_of_centre * at_start) {
                error =
                    fmt::format("the arc's centre is {:.4f} away from the centre of a circle through both ends", moved);
                return arc;
            }
        }
    }
    Vec3 at = words.begin;
    at[u] = centre.x();
    at[v] = centre.y();
    arc.centre = Xyz(at);
    return arc;
}

double arc_sweep(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end) {
    const int u = (arc.axis + 1) % 3;
    const int v = (arc.axis + 2) % 3;
    const Vec3 centre = arc.centre.vec();
    const Vec2 from(begin[u] - centre[u], begin[v] - centre[v]);
    const Vec2 to(end[u] - centre[u], end[v] - centre[v]);
    constexpr double two_pi = 2 * std::numbers::pi;
    double sweep = angle_of(to) - angle_of(from);
    if (clockwise) sweep = -sweep;
    while (sweep <= 1e-9) sweep += two_pi;
    return sweep + two_pi * (arc.turns - 1);
}

double arc_length(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end) {
    const int u = (arc.axis + 1) % 3;
    const int v = (arc.axis + 2) % 3;
    const Vec3 centre = arc.centre.vec();
    const double at_begin = std::hypot(begin[u] - centre[u], begin[v] - centre[v]);
    const double at_end = std::hypot(end[u] - centre[u], end[v] - centre[v]);
    return std::hypot(0.5 * (at_begin + at_end) * arc_sweep(arc, clockwise, begin, end),
                      end[arc.axis] - begin[arc.axis]);
}

int chord_count(double radius, double sweep, double widening, double error) {
    // A chord over the fraction h of a curve p(0 … 1) is within h²/8 · max |p''| of it. A spiral's p'' has a radial
    // component, radius · sweep², and a tangential one, 2 · widening · sweep.
    const double second_derivative = std::hypot(radius * sweep * sweep, 2 * widening * sweep);
    return static_cast<int>(std::clamp(std::ceil(std::sqrt(second_derivative / (8 * error))), 1.0, most_chords));
}

std::vector<Vec3> arc_chords(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end, double error) {
    const int u = (arc.axis + 1) % 3;
    const int v = (arc.axis + 2) % 3;
    const Vec3 centre = arc.centre.vec();
    const double at_begin = std::hypot(begin[u] - centre[u], begin[v] - centre[v]);
    const double widening = std::hypot(end[u] - centre[u], end[v] - centre[v]) - at_begin;
    const double sweep = arc_sweep(arc, clockwise, begin, end);
    const double first = std::atan2(begin[v] - centre[v], begin[u] - centre[u]);
    const int count = chord_count(at_begin + std::max(0.0, widening), sweep, widening, error);
    std::vector<Vec3> ends;
    ends.reserve(static_cast<std::size_t>(count));
    for (int k = 1; k < count; ++k) {
        const double part = static_cast<double>(k) / count;
        const double radius = at_begin + part * widening;
        const double angle = first + part * (clockwise ? -sweep : sweep);
        Vec3 p = begin + part * (end - begin);
        p[u] = centre[u] + radius * std::cos(angle);
        p[v] = centre[v] + radius * std::sin(angle);
        ends.push_back(p);
    }
    ends.push_back(end);
    return ends;
}

}  // namespace clsurf
