#include "surface/passes.h"

#include <array>
#include <vector>

#include "core/block.h"
#include "toolpath/chords.h"

namespace clsurf {
namespace {

constexpr float turning_cosine = -0.5F;       ///< chords that enclose more than 120° turn back
constexpr double chord_step_overs = 1.5;      ///< arc length of a chord
constexpr float corner_tolerance = 1e-6F;     ///< [mm²] reach times chord; less is not progress
constexpr double shortest_pass = 2.0;         ///< step-overs of arc length; a shorter piece is part of its link
constexpr float vertical_slope = 0.02F;       ///< horizontal per vertical arc length of an approach
constexpr float vertical_tolerance = 0.005F;  ///< [mm]
constexpr float least_approach = 0.1F;        ///< [mm]; a shorter vertical piece is not removed
constexpr float rounded_corner = 0.1F;        ///< [mm] sideways, if the controller rounds the corner before an approach

float aside(const Eigen::Vector3f& offset) { return std::hypot(offset.x(), offset.y()); }

/// The end of a rounded corner between a rapid and a vertical approach, from its middle on: it is steep, and becomes
/// vertical.
PointIndex end_of_corner(const Positions& p, PointIndex from, PointIndex to, int direction) {
    PointIndex i = from;
    while (i != to && aside(p[i + direction] - p[from]) < rounded_corner) {
        const Eigen::Vector3f step = p[i + direction] - p[i];
        const float down = std::abs(step.z());
        if (aside(step) <= vertical_slope * down || aside(step) > down) break;
        i += direction;
    }
    return i;
}

/// Number of points of [from, to], in steps of `direction` from `from`, that only move along z.
PointIndex vertical_points(const Positions& p, PointIndex from, PointIndex to, int direction) {
    PointIndex i = end_of_corner(p, from, to, direction);
    const Eigen::Vector3f start = p[i];
    while (i != to) {
        const Eigen::Vector3f offset = p[i + direction] - start;
        if (aside(offset) > vertical_tolerance + vertical_slope * std::abs(offset.z())) break;
        i += direction;
    }
    if (std::abs((p[i] - start).z()) < least_approach) return 0;
    return std::abs(i - from);
}

/// A cutting run without its vertical approach and retract.
void append_run(Passes& passes, const Positions& p, Pass run) {
    const PointIndex down = vertical_points(p, run.first, run.last, +1);
    if (down > 0 && down == run.size() - 1) {  // only vertical: drilling
        append_pass(passes, {run.first, run.last, PassKind::rapid});
        return;
    }
    append_pass(passes, {run.first, run.first + down - 1, PassKind::rapid});
    run.first += down;
    if (run.size() <= 0) return;
    const PointIndex up = vertical_points(p, run.last, run.first, -1);
    append_pass(passes, {run.first, run.last - up, PassKind::cut});
    append_pass(passes, {run.last - up + 1, run.last, PassKind::rapid});
}

}  // namespace

void append_pass(Passes& passes, Pass piece) {
    if (piece.size() <= 0) return;
    if (!passes.empty() && passes.back().kind == piece.kind) {
        passes.back().last = piece.last;
        return;
    }
    passes.push_back(piece);
}

Passes find_runs(const Positions& positions, const LineMap& lines) {
    const PointIndex count = positions.size();
    const auto blocks = static_cast<std::size_t>((count + block_points - 1) / block_points);
    std::vector<Passes> of_block(blocks);
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        Passes& mine = of_block[static_cast<std::size_t>(first / block_points)];
        std::array<PointKind, 1024> kinds;
        for (PointIndex begin = first; begin < last; begin += 1024) {
            const auto n = static_cast<std::size_t>(std::min<PointIndex>(1024, last - begin));
            lines.read_kinds(begin, {kinds.data(), n});
            for (std::size_t k = 0; k < n; ++k) {
                const PointIndex i = begin + static_cast<PointIndex>(k);
                const bool cuts = kinds[k] == PointKind::cut && positions[i].allFinite();
                append_pass(mine, {i, i, cuts ? PassKind::cut : PassKind::rapid});
            }
        }
    });
    Passes joined;
    for (const Passes& block : of_block) {
        for (const Pass& piece : block) append_pass(joined, piece);
    }
    Passes runs;
    for (const Pass& piece : joined) {
        if (piece.kind == PassKind::cut) {
            append_run(runs, positions, piece);
        } else {
            append_pass(runs, piece);
        }
    }
    return runs;
}

namespace {

/// Whether the path turns back.
bool turns_back(const Positions& p, const Chords& chords, float arc_length) {
    // Near the end of a run the path ahead is too short for a decision.
    if (chords.arc_length_behind() < 0.5F * arc_length || chords.arc_length_ahead() < 0.5F * arc_length) return false;
    const Eigen::Vector3f here = p[chords.point()];
    const Eigen::Vector3f back = here - p[chords.behind()];
    const Eigen::Vector3f ahead = p[chords.ahead()] - here;
    // cos < −1/2 without roots: both sides squared, the sign kept.
    const float dot = back.dot(ahead);
    return dot < 0 && dot * dot > turning_cosine * turning_cosine * back.squaredNorm() * ahead.squaredNorm();
}

/// Pieces between two links that are too short to be passes become part of the link.
void append_cleaned(Passes& passes, const ArcLength& arc_length, const Passes& pieces, double least) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        Pass piece = pieces[i];
        const bool between = i > 0 && i + 1 < pieces.size();
        if (piece.kind == PassKind::cut && between && arc_length.to(piece.last) - arc_length.to(piece.first) < least) {
            piece.kind = PassKind::link;
        }
        append_pass(passes, piece);
    }
}

/// The point of [from, to] that is farthest in a direction; the first such point, counted from `from`.
PointIndex farthest(const Positions& p, PointIndex from, PointIndex to, const Eigen::Vector3f& direction) {
    PointIndex best = from;
    float most = 0;
    const PointIndex step = to >= from ? 1 : -1;
    for (PointIndex i = from; i != to + step; i += step) {
        const float arc_length = (p[i] - p[from]).dot(direction);
        if (arc_length > most + corner_tolerance) {
            most = arc_length;
            best = i;
        }
    }
    return best;
}

/// Chords detect a turn before it begins. The pass ends at its outermost point, and the next begins at its own; the
/// points between are the link.
void tighten_links(Passes& passes, const Positions& p, const ArcLength& lengths, float arc_length) {
    for (std::size_t k = 1; k + 1 < passes.size(); ++k) {
        Pass& link = passes[k];
        Pass& before = passes[k - 1];
        Pass& after = passes[k + 1];
        if (link.kind != PassKind::link || before.kind != PassKind::cut || after.kind != PassKind::cut) continue;
        const Chords arriving(lengths, {before.first, link.first}, link.first, arc_length);
        const Chords leaving(lengths, {link.last, after.last}, link.last, arc_length);
        const PointIndex end = farthest(p, link.first, link.last, p[link.first] - p[arriving.behind()]);
        const PointIndex begin = farthest(p, link.last, link.first, p[link.last] - p[leaving.ahead()]);
        if (end >= begin) continue;  // no points between the corners: leave the link as detected
        before.last = end;
        link.first = end + 1;
        link.last = std::max(end + 1, begin - 1);
        after.first = link.last + 1;
    }
}

}  // namespace

Passes find_passes(const Positions& positions, const ArcLength& lengths, const Passes& runs, double step_over) {
    const auto arc_length = static_cast<float>(chord_step_overs * step_over);
    Passes passes;
    for (const Pass& run : runs) {
        if (run.kind != PassKind::cut) {
            append_pass(passes, run);
            continue;
        }
        const auto parts = static_cast<std::size_t>((run.size() + block_points - 1) / block_points);
        std::vector<Passes> of_part(parts);
        for_each_block(run.size(), [&](PointIndex first, PointIndex last) {
            Passes& mine = of_part[static_cast<std::size_t>(first / block_points)];
            Chords chords(lengths, {run.first, run.last}, run.first + first, arc_length);
            PointIndex begin = run.first + first;
            bool before = turns_back(positions, chords, arc_length);
            for (PointIndex i = begin + 1; i < run.first + last; ++i) {
                chords.advance();
                const bool back = turns_back(positions, chords, arc_length);
                if (back == before) continue;
                append_pass(mine, {begin, i - 1, before ? PassKind::link : PassKind::cut});
                begin = i;
                before = back;
            }
            append_pass(mine, {begin, run.first + last - 1, before ? PassKind::link : PassKind::cut});
        });
        Passes pieces;
        for (const Passes& part : of_part) {
            for (const Pass& piece : part) append_pass(pieces, piece);
        }
        append_cleaned(passes, lengths, pieces, shortest_pass * step_over);
    }
    tighten_links(passes, positions, lengths, arc_length);
    return passes;
}

}  // namespace clsurf
