#include "simulation/path/spline_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace clsurf {
namespace {

constexpr double no_height = 1e-9;         ///< [mm] greatest distance of a span in a principal plane from that plane
constexpr double no_section_turn = 1e-7;   ///< [rad] a section that turns less is a line
constexpr double most_section_turn = 1.5;  ///< [rad] of one section
constexpr int compared_places = 8;         ///< compared places of a pair of arcs
constexpr int most_section_halvings = 12;

/// The arc from a point in a direction to another point; a line if it does not turn.
PathElement tangent_arc(const Vec3& begin, const Vec3& tangent, const Vec3& end, const Vec3& normal) {
    const Vec3 chord = end - begin;
    const Vec3 left = normal.cross(tangent);
    const double half_turn = std::atan2(chord.dot(left), chord.dot(tangent));
    if (std::abs(half_turn) < no_section_turn) return element_of(MotionKind::feed, nullptr, begin, end);
    PathElement e;
    e.arc = true;
    e.begin = begin;
    e.end = end;
    const double radius = chord.norm() / (2 * std::sin(half_turn));  // positive: to the left
    e.centre = begin + radius * left;
    e.radius = std::abs(radius);
    e.first = (begin - e.centre) / e.radius;
    e.second = tangent;
    e.rate = 1 / e.radius;
    e.length = 2 * std::abs(half_turn) * e.radius;
    return e;
}

/// Two arcs between two points with given tangents; the tangent lengths to their joint are equal.
std::optional<std::array<PathElement, 2>> pair_of_arcs(const Vec3& begin, const Vec3& tangent, const Vec3& end,
                                                       const Vec3& last_tangent, const Vec3& normal) {
    const Vec3 v = end - begin, t = tangent + last_tangent;
    const double opening = 2 * (1 - tangent.dot(last_tangent));
    const double along = v.dot(t), square = v.squaredNorm();
    if (!(along > 0)) return std::nullopt;
    const double arm = square / (along + std::sqrt(along * along + opening * square));
    const Vec3 joint = 0.5 * (begin + end + arm * (tangent - last_tangent));
    const PathElement first = tangent_arc(begin, tangent, joint, normal);
    if (!(first.length > 0)) return std::nullopt;
    const PathElement second = tangent_arc(joint, first.tangent(first.length).normalized(), end, normal);
    if (!(second.length > 0)) return std::nullopt;
    return std::array<PathElement, 2>{first, second};
}

/// Distance of a point from an arc or a line [mm].
double distance_from_section(const PathElement& e, const Vec3& p) {
    if (e.arc) return std::abs((p - e.centre).norm() - e.radius);
    const double along = std::clamp((p - e.begin).dot(e.direction), 0.0, e.length);
    return (e.begin + along * e.direction - p).norm();
}

}  // namespace

void SplineSections::add_lines(const PathElement& span) {
    Vec3 at = span.begin;
    for (const double t : span.spline->chord_ends(error)) {
        const Vec3 end = t >= 1 ? span.end : span.spline->at(t);
        const PathElement line = element_of(MotionKind::feed, nullptr, at, end);
        at = end;
        if (line.length > 0) ready_.push_back(line);
    }
}

void SplineSections::add_arcs(const PathElement& span, int axis, double from, double to, int depth) {
    const BezierCurve& curve = *span.spline;
    const Vec3 normal = Vec3::Unit(axis);
    const Vec3 begin = curve.at(from), end = curve.at(to);
    const Vec3 first_tangent = curve.tangent(from), last_tangent = curve.tangent(to);
    const auto pair = std::acos(std::clamp(first_tangent.dot(last_tangent), -1.0, 1.0)) < most_section_turn
                          ? pair_of_arcs(begin, first_tangent, end, last_tangent, normal)
                          : std::nullopt;
    double off = pair ? 0 : 2 * error;
    for (int k = 1; pair && k < compared_places; ++k) {
        const Vec3 p = curve.at(from + (to - from) * k / compared_places);
        const PathElement &first = (*pair)[0], &second = (*pair)[1];
        const bool in_first = (p - first.end).dot(first.tangent(first.length)) <= 0;
        off = std::max(off, distance_from_section(in_first ? first : second, p));
    }
    if (off <= error) {
        for (const PathElement& arc : *pair) ready_.push_back(arc);
        return;
    }
    if (depth == most_section_halvings) {
        const PathElement line = element_of(MotionKind::feed, nullptr, begin, end);
        if (line.length > 0) ready_.push_back(line);
        return;
    }
    const double middle = 0.5 * (from + to);
    add_arcs(span, axis, from, middle, depth + 1);
    add_arcs(span, axis, middle, to, depth + 1);
}

void SplineSections::divide(const PathElement& span) {
    int plane = -1;
    for (int axis = 0; axis < 3 && plane < 0; ++axis) {
        bool flat = true;
        for (std::size_t i = 0; i <= static_cast<std::size_t>(span.spline->degree()); ++i)
            flat = flat && std::abs(span.spline->point(i)[axis] - span.begin[axis]) <= no_height;
        if (flat) plane = axis;
    }
    if (plane < 0)
        add_lines(span);
    else
        add_arcs(span, plane, 0, 1, 0);
    for (PathElement& section : ready_) {
        section.take_block(span);
        section.block_length = section.length;
        section.stops = &section == &ready_.back() && span.stops;
    }
}

bool SplineSections::next(PathElement& element) {
    while (ready_.empty()) {
        if (!source_->next(element)) return false;
        if (!element.spline) return true;
        divide(element);
    }
    element = ready_.front();
    ready_.pop_front();
    return true;
}

}  // namespace clsurf
