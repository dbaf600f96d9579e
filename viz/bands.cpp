#include "viz/bands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/parallel.h"
#include "surface/missing_pass.h"
#include "viz/geometry.h"

namespace clsurf::viz {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr std::int64_t longest_gap = 512;  ///< vertices of a pass between two that have a neighbour, and of a seam
constexpr float longest_seam =
    10.0F;  ///< arc length of both passes along a seam, in band widths; of a gap, in step-overs
constexpr float widest_seam = 2.2F;          ///< length of an edge of a seam, in widths of the adjoining band
constexpr double tangent_step_overs = 0.08;  ///< arc length on either side for the tangent at a vertex
constexpr float most_askew = 0.3F;           ///< cosine of the angle between path and direction to the neighbour
constexpr float least_width = 0.6F;    ///< width of a band, in step-overs; a narrower band is already close to a corner
constexpr float widest_end = 1.5F;     ///< widest seam between two ends, in widths
constexpr float leading_away = 0.85F;  ///< growth of the edge per arc length from which the paths diverge
constexpr float corner_tolerance = 1.03F;  ///< growth of an edge that is still at the ends of its passes
constexpr float closed_seam = 0.5F;        ///< edge length at which a seam is closed, in widths
constexpr float longest_fan_arc_length =
    8.0F;  ///< arc length of a neighbour spanned by one step, minus that of the step, in step-overs
constexpr std::int64_t longest_fan = 256;  ///< vertices of a neighbour spanned by one step

class Bander {
public:
    Bander(const ClSurface& surface, const SectionVertices& vertices, const NearnessFrame& frame, float reach)
        : s_(surface), v_(vertices), frame_(frame), reach_(reach) {
        const auto count = static_cast<std::int64_t>(v_.points.size());
        for (const Side side : {Side::left, Side::right}) across(side).resize(v_.points.size());
        parallel_for(count, 16384, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t b = first; b < last; ++b) {
                for (const Side side : {Side::left, Side::right})
                    across(side)[static_cast<std::size_t>(b)] = seen_across(b, side);
            }
        });
        for (const Side side : {Side::left, Side::right}) drop_short(side);
    }

    void bands(std::int64_t first, std::int64_t last, Column<std::uint32_t>& triangles,
               Column<std::uint32_t>& segments) const {
        for (std::int64_t b = first; b < last; ++b) {
            for (const Side side : {Side::left, Side::right}) close_ends(b, side, triangles);
            if (!joined(b)) continue;
            bool alone = true;
            for (const Side side : {Side::left, Side::right}) {
                alone = alone && !(s_.neighbours.has(side, point(b - 1)) && s_.neighbours.has(side, point(b)));
                if (has_earlier(b - 1, side) && has_earlier(b, side))
                    band(b, earlier(b - 1, side), earlier(b, side), triangles);
            }
            if (alone) {
                segments.push_back(static_cast<std::uint32_t>(b - 1));
                segments.push_back(static_cast<std::uint32_t>(b));
            }
        }
    }

private:
    /// Whether a vertex is connected to the previous one.
    [[nodiscard]] bool joined(std::int64_t vertex) const { return v_.joined[static_cast<std::size_t>(vertex)] != 0; }
    [[nodiscard]] bool link(std::int64_t vertex) const { return v_.links[static_cast<std::size_t>(vertex)] != 0; }
    [[nodiscard]] bool goes_on(std::int64_t vertex, int direction) const {
        const std::int64_t next = vertex + direction;
        return next >= 0 && next < static_cast<std::int64_t>(v_.points.size()) && joined(std::max(vertex, next));
    }
    [[nodiscard]] float distance(std::int64_t a, std::int64_t b) const {
        return (s_.positions[point(a)] - s_.positions[point(b)]).norm();
    }

    static constexpr std::int32_t none = -1;   ///< no neighbour at the vertex
    static constexpr std::int32_t later = -2;  ///< … a later part of the path, which makes the band
    static constexpr std::int32_t apart = -3;  ///< … not the adjacent pass: one is missing in between

    [[nodiscard]] Column<std::int32_t>& across(Side side) { return side == Side::left ? left_ : right_; }
    [[nodiscard]] std::int32_t earlier(std::int64_t vertex, Side side) const {
        return (side == Side::left ? left_ : right_)[static_cast<std::size_t>(vertex)];
    }
    /// Each gap is filled once, from its later pass.
    [[nodiscard]] bool has_earlier(std::int64_t vertex, Side side) const { return earlier(vertex, side) >= 0; }

    /// The vertex of the earlier pass opposite to a vertex. At a corner the search for neighbours may look along the
    /// bend: a neighbour that is not across the path does not count here, and a seam closes the gap.
    [[nodiscard]] std::int32_t seen_across(std::int64_t b, Side side) const {
        const PointIndex i = point(b);
        if (!s_.neighbours.has(side, i) || link(b)) return none;
        const PointIndex m = s_.neighbours.neighbour(side, i);
        const std::int64_t a = m < i ? vertex_of(m) : -1;
        if (m < i && (a < 0 || link(a))) return none;
        const auto arc_length = static_cast<float>(tangent_step_overs * s_.step_over);
        const Vec3f tangent =
            s_.positions[point(moved(b, +1, arc_length))] - s_.positions[point(moved(b, -1, arc_length))];
        const Vec3f d = s_.positions[m < i ? point(a) : m] - s_.positions[i];
        const float along = std::abs(d.dot(tangent));
        // Vertices are sparse: the opposite one may be half a step off.
        const float step = m < i ? distance(goes_on(a, -1) ? a - 1 : a, goes_on(a, +1) ? a + 1 : a) : 0.0F;
        if (along > (most_askew * d.norm() + 0.5F * step) * tangent.norm()) return none;
        if (m > i) return later;
        return misses_pass(s_, i, side) ? apart : static_cast<std::int32_t>(a);
    }

    /// Whether the neighbour at a vertex is on the same pass as that at the previous vertex.
    [[nodiscard]] bool same_across(std::int64_t vertex, Side side) const {
        if (!joined(vertex)) return false;
        const std::int32_t now = earlier(vertex, side);
        const std::int32_t before = earlier(vertex - 1, side);
        if (now < 0 || before < 0) return now == before;
        const float tolerance = 0.3F * static_cast<float>(s_.step_over);
        const float step = distance(vertex - 1, vertex);
        if (std::abs(distance(vertex, now) - distance(vertex - 1, before)) <= tolerance + 0.5F * step) return true;
        // If vertices are far apart, the opposite ones may be ahead or behind, and their distance says little.
        return arc_length_but_one_chord(before, now) <= tolerance + step;
    }

    /// In a bend, another bend can briefly be the neighbour; after a turn, the pass beyond the adjacent one can. A
    /// neighbour over less than a step-over is therefore dropped, unless its section begins at the edge of the picture.
    void drop_short(Side side) {
        const auto count = static_cast<std::int64_t>(v_.points.size());
        constexpr std::int64_t grain = 16384;
        std::vector<std::vector<std::int64_t>> found(static_cast<std::size_t>((count + grain - 1) / grain));
        const auto least = static_cast<float>(s_.step_over);
        parallel_for(count, grain, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t b = first; b < last; ++b) {
                if (earlier(b, side) == none || same_across(b, side)) continue;
                float arc_length = 0;
                std::int64_t end = b + 1;
                for (; end < count && arc_length < least && same_across(end, side); ++end)
                    arc_length += distance(end - 1, end);
                if (arc_length >= least || !joined(b) || end == count || !joined(end)) continue;
                for (std::int64_t v = b; v < end; ++v) found[static_cast<std::size_t>(first / grain)].push_back(v);
            }
        });
        for (const std::vector<std::int64_t>& part : found) {
            for (const std::int64_t v : part) across(side)[static_cast<std::size_t>(v)] = none;
        }
    }

    /// The vertex at a distance [mm] from another one, or the last connected vertex.
    [[nodiscard]] std::int64_t moved(std::int64_t vertex, int direction, float arc_length) const {
        const std::int64_t from = vertex;
        constexpr std::int64_t farthest = 32;
        while (std::abs(vertex - from) < farthest && goes_on(vertex, direction)) {
            vertex += direction;
            if (distance(vertex, from) >= arc_length) break;
        }
        return vertex;
    }

    /// The first vertex in a direction with a neighbour on a side; −1: no connected vertex is close enough,
    /// or the neighbour is on a later part of the path.
    [[nodiscard]] std::int64_t beyond_gap(std::int64_t vertex, int direction, Side side) const {
        float arc_length = 0;
        const float longest = longest_seam * static_cast<float>(s_.step_over);
        for (std::int64_t looked = 0; looked < longest_gap && arc_length < longest && goes_on(vertex, direction);
             ++looked) {
            arc_length += distance(vertex, vertex + direction);
            vertex += direction;
            if (earlier(vertex, side) != none) return has_earlier(vertex, side) ? vertex : -1;
        }
        return -1;
    }

    /// Closes the gap between passes where the bands of a vertex end with a seam: at a turn up
    /// to the turn, at the ends of two passes up to the line between the ends, at corners up to
    /// the next band, and where a loop returns to its beginning up to that beginning.
    void close_ends(std::int64_t b, Side side, Column<std::uint32_t>& triangles) const {
        if (!has_earlier(b, side)) return;
        // A gap between two bands is closed from its end if it ends there, otherwise from its beginning.
        if (!goes_on(b, +1) || (earlier(b + 1, side) == none && beyond_gap(b, +1, side) < 0)) {
            (void)seam(b, +1, side, triangles);
        }
        if (goes_on(b, -1) && earlier(b - 1, side) != none) return;
        const std::int64_t before = beyond_gap(b, -1, side);
        if (before >= 0 && seam(before, +1, side, triangles)) return;
        (void)seam(b, -1, side, triangles);
    }

    /// Whether a seam may advance at a vertex. Both passes lead into the link of a turn. For passes in the same direction
    /// only the end of the earlier leads to the beginning of the later; their other links go to other passes.
    [[nodiscard]] bool may_move(std::int64_t vertex, int step, bool leads_across, bool through_links,
                                bool alike) const {
        if (!goes_on(vertex, step)) return false;
        const bool linked = link(vertex + step);
        if (!through_links) return !linked;
        return !alike || (leads_across && (linked || link(vertex)));
    }

    /// Extends the band from its edge at the own vertex b in a direction: the edge advances on either pass, so that
    /// it stays short, until the passes meet. If they do not meet, the seam ends between their ends.
    /// Returns whether it reached the next band.
    bool seam(std::int64_t b, int b_step, Side side, Column<std::uint32_t>& triangles) const {
        std::int64_t a = earlier(b, side);
        const int a_step = step_across(a, b, b_step);
        const float first = distance(a, b);
        const float width = std::max(first, least_width * static_cast<float>(s_.step_over));
        const std::size_t begin = triangles.size();
        std::size_t at_ends = begin;    // triangles up to the ends of the passes
        std::size_t narrowest = begin;  // triangles up to the shortest edge
        float narrow = first;
        bool through_links = false;
        float most_at_ends = 0;  // longest edge that is still between the ends
        float now = first;
        float arc_length = 0;  // of both passes
        bool turned = false;   // the two paths diverge
        for (std::int64_t moved = 0; moved < longest_gap; ++moved) {
            if (a_step > 0 && b_step < 0 && b - a <= 1) return false;  // met in the turn
            const bool a_may = may_move(a, a_step, b_step > 0, through_links, a_step == b_step);
            const bool b_may = may_move(b, b_step, b_step < 0, through_links, a_step == b_step);
            if (!a_may && !b_may) {
                if (through_links) break;
                at_ends = triangles.size();
                through_links = true;
                most_at_ends = corner_tolerance * distance(a, b);
                continue;
            }
            const float if_a = a_may ? distance(a + a_step, b) : std::numeric_limits<float>::infinity();
            const float if_b = b_may ? distance(a, b + b_step) : std::numeric_limits<float>::infinity();
            const float length = std::min(if_a, if_b);
            arc_length += if_a <= if_b ? distance(a, a + a_step) : distance(b, b + b_step);
            if (length > widest_seam * width || arc_length > longest_seam * width) break;
            // If a turn is not a separate link, its corners are the ends of the passes.
            if (!turned && !through_links && now < widest_end * width &&
                (!a_may || if_a - now > leading_away * distance(a, a + a_step)) &&
                (!b_may || if_b - now > leading_away * distance(b, b + b_step))) {
                at_ends = triangles.size();
                turned = true;
            }
            now = length;
            if (narrow < closed_seam * width && length > std::max(1.5F * narrow, closed_seam * width)) break;
            const bool other_moves = if_a <= if_b;
            add(triangles, static_cast<std::uint32_t>(a),
                static_cast<std::uint32_t>(other_moves ? a + a_step : b + b_step), static_cast<std::uint32_t>(b));
            (other_moves ? a : b) += other_moves ? a_step : b_step;
            if (!other_moves && has_earlier(b, side)) {
                if (fan(b, a, earlier(b, side), 0, triangles)) return true;
                break;
            }
            // A pass ends slightly before its corner: continue up to the corner.
            if (length <= most_at_ends)
                at_ends = triangles.size();
            else if (through_links)
                most_at_ends = 0;
            if (length < narrow) {
                narrow = length;
                narrowest = triangles.size();
            }
        }
        triangles.resize(narrow < closed_seam * width ? narrowest : at_ends);
        return false;
    }

    /// The direction on the other pass that corresponds to b_step on the own one: away from
    /// the band.
    [[nodiscard]] int step_across(std::int64_t a, std::int64_t b, int b_step) const {
        const auto arc_length = static_cast<float>(s_.step_over);
        const auto chord = [&](std::int64_t from, int direction) -> Vec3f {
            return s_.positions[point(moved(from, direction, arc_length))] - s_.positions[point(from)];
        };
        const Vec3f back = chord(b, -b_step);
        return chord(a, +1).dot(back) > chord(a, -1).dot(back) ? -1 : 1;
    }

    [[nodiscard]] PointIndex point(std::int64_t vertex) const { return v_.points[static_cast<std::size_t>(vertex)]; }

    [[nodiscard]] Vec3f placed(PointIndex i) const { return frame_.linear * s_.positions[i] + frame_.shift; }

    /// The vertex that represents a point; −1: the point is not drawn.
    [[nodiscard]] std::int64_t vertex_of(PointIndex n) const {
        const auto* found = std::lower_bound(v_.points.begin(), v_.points.end(), n);
        std::int64_t best = -1;
        float best_distance = reach_ * reach_;
        const Vec3f at = placed(n);
        const std::int64_t k = found - v_.points.begin();
        for (std::int64_t c = std::max<std::int64_t>(0, k - 1);
             c <= k && c < static_cast<std::int64_t>(v_.points.size()); ++c) {
            const float distance = (placed(point(c)) - at).squaredNorm();
            if (distance < best_distance) {
                best_distance = distance;
                best = c;
            }
        }
        return best;
    }

    /// Triangles between the own vertices b − 1, b and the neighbour's vertices from one to another.
    void band(std::int64_t b, std::int64_t from, std::int64_t to, Column<std::uint32_t>& triangles) const {
        if (!fan(b - 1, from, to, distance(b - 1, b), triangles)) {
            // A loop that returns to its beginning: close in space, but not along the path.
            if (distance(from, to) > 0.75F * static_cast<float>(s_.step_over) + distance(b - 1, b)) return;
            add(triangles, static_cast<std::uint32_t>(b - 1), static_cast<std::uint32_t>(from),
                static_cast<std::uint32_t>(to));
        }
        add(triangles, static_cast<std::uint32_t>(b - 1), static_cast<std::uint32_t>(to),
            static_cast<std::uint32_t>(b));
    }

    /// The arc length [mm] between two vertices without its longest chord: if vertices are far apart, one chord can exceed
    /// a limit that suits many. Infinite if the vertices are not on one piece of the path, or too many are between them.
    [[nodiscard]] float arc_length_but_one_chord(std::int64_t from, std::int64_t to) const {
        if (std::abs(to - from) > longest_fan) return std::numeric_limits<float>::infinity();
        const int direction = to >= from ? 1 : -1;
        float arc_length = 0;
        float longest = 0;
        for (std::int64_t k = from; k != to; k += direction) {
            if (!goes_on(k, direction)) return std::numeric_limits<float>::infinity();
            const float chord = distance(k, k + direction);
            arc_length += chord;
            longest = std::max(longest, chord);
        }
        return arc_length - longest;
    }

    /// Triangles from a vertex to the neighbour's vertices from one to another; own_step [mm] is the own arc length. False
    /// if these vertices are not on one piece of the path, or far apart: after a jump to another piece there is no neighbour.
    bool fan(std::int64_t own, std::int64_t from, std::int64_t to, float own_step,
             Column<std::uint32_t>& triangles) const {
        if (arc_length_but_one_chord(from, to) > longest_fan_arc_length * static_cast<float>(s_.step_over) + own_step)
            return false;
        const int direction = to >= from ? 1 : -1;
        for (std::int64_t k = from; k != to; k += direction) {
            add(triangles, static_cast<std::uint32_t>(own), static_cast<std::uint32_t>(k),
                static_cast<std::uint32_t>(k + direction));
        }
        return true;
    }

    static void add(Column<std::uint32_t>& triangles, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        triangles.push_back(a);
        triangles.push_back(b);
        triangles.push_back(c);
    }

    const ClSurface& s_;
    const SectionVertices& v_;
    NearnessFrame frame_;
    float reach_;
    Column<std::int32_t> left_, right_;  ///< per vertex: the opposite vertex, none, later or apart
};

}  // namespace

Passes sections_of_path(const ClSurface& surface) {
    Passes pieces;
    StepOverMoveCutter cutter(surface.step_over_moves);
    for (const Pass& pass : surface.passes) {
        cutter.cut({pass.first, pass.last}, [&](const PointRange& part, bool step_over_move) {
            pieces.push_back({part.first, part.last, step_over_move ? PassKind::link : pass.kind});
        });
    }
    return pieces;
}

SectionVertices section_vertices(const ClSurface& surface, std::span<const PointIndex> points) {
    SectionVertices vertices;
    vertices.points.reserve(points.size());
    std::size_t at = 0;
    const Passes pieces = sections_of_path(surface);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Pass& piece = pieces[k];
        const bool rapid = !is_of_surface(piece.kind);
        // Consecutive pieces of one run (pass, link, the next turn of a spiral) are connected.
        bool joins = k > 0 && is_of_surface(pieces[k - 1].kind);
        for (; at < points.size() && points[at] <= piece.last; ++at) {
            vertices.points.push_back(points[at]);
            vertices.joined.push_back(joins && !rapid ? 1 : 0);
            vertices.links.push_back(piece.kind == PassKind::link ? 1 : 0);
            joins = true;
        }
    }
    return vertices;
}

Bands join_passes(const ClSurface& surface, const SectionVertices& vertices, const NearnessFrame& frame, float reach) {
    return std::move(
        join_passes(surface, vertices, frame, reach, 0, static_cast<std::int64_t>(vertices.points.size()))[1]);
}

std::array<Bands, 3> join_passes(const ClSurface& surface, const SectionVertices& vertices, const NearnessFrame& frame,
                                 float reach, std::int64_t first, std::int64_t end) {
    const Bander bander(surface, vertices, frame, reach);
    constexpr std::int64_t grain = 16384;
    const auto made = [&](std::int64_t begin, std::int64_t behind) {
        std::vector<Bands> of_piece(static_cast<std::size_t>((behind - begin + grain - 1) / grain));
        parallel_for(behind - begin, grain, [&](std::int64_t from, std::int64_t to) {
            Bands& piece = of_piece[static_cast<std::size_t>(from / grain)];
            bander.bands(begin + from, begin + to, piece.triangles, piece.segments);
        });
        Bands all;
        for (const Bands& piece : of_piece) {
            append(all.triangles, piece.triangles);
            append(all.segments, piece.segments);
        }
        return all;
    };
    return {made(0, first), made(first, end), made(end, static_cast<std::int64_t>(vertices.points.size()))};
}

Column<std::int64_t> triangles_of(const ClSurface& surface) {
    Column<PointIndex> every(static_cast<std::size_t>(surface.positions.size()));
    std::iota(every.begin(), every.end(), PointIndex{0});
    const SectionVertices vertices = section_vertices(surface, every);
    const Bands bands = join_passes(surface, vertices, {}, static_cast<float>(surface.step_over));
    Column<std::int64_t> triangles(bands.triangles.size());
    for (std::size_t k = 0; k < triangles.size(); ++k) triangles[k] = vertices.points[bands.triangles[k]];
    return triangles;
}

}  // namespace clsurf::viz
