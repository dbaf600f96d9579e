#include "surface/stitch.h"

#include <algorithm>
#include <utility>

#include "surface/cut_groups.h"
#include "surface/finishing.h"
#include "surface/step_over.h"

namespace clsurf {
namespace {

constexpr double link_reach =
    4.0;  ///< step-overs of arc length around a seam within which the link of a loop is searched for
constexpr float direction_half = 0.25F;  ///< step-overs of arc length from a point to the ends of its own chord
constexpr float run_near = 0.6F;         ///< … and of the chords before and after it
constexpr float run_far = 2.0F;
constexpr float step_over_move_cosine =
    0.7F;  ///< a step-over move turns off by more than 45° and returns to the old direction

/// Finds the step-over moves between closed loops: adjacent sections before and after with the same direction.
class StepOverMoveFinder {
public:
    StepOverMoveFinder(const Positions& positions, const ArcLength& arc_length, double step_over)
        : p_(positions), arc_length_(arc_length), step_over_(static_cast<float>(step_over)) {}

    /// The step-over move nearest to a seam inside a pass; empty: a spiral has none.
    [[nodiscard]] PointRange step_over_move_at(PointIndex seam, const PointRange& pass) const {
        const PointIndex first = back(seam, static_cast<float>(link_reach), pass.first);
        const PointIndex last = ahead(seam, static_cast<float>(link_reach), pass.last);
        PointRange step_over_move;
        for (PointIndex i = first; i <= last; ++i) {
            if (!step_over_moves(i, pass)) continue;
            if (step_over_move.size() <= 0) step_over_move.first = i;
            step_over_move.last = i;
        }
        return step_over_move;
    }

private:
    [[nodiscard]] PointIndex back(PointIndex i, float step_overs, PointIndex limit) const {
        float gone = 0;
        while (i > limit && gone < step_overs * step_over_) gone += arc_length_.step(--i);
        return i;
    }
    [[nodiscard]] PointIndex ahead(PointIndex i, float step_overs, PointIndex limit) const {
        float gone = 0;
        while (i < limit && gone < step_overs * step_over_) gone += arc_length_.step(i++);
        return i;
    }
    [[nodiscard]] bool step_over_moves(PointIndex i, const PointRange& pass) const {
        const auto direction = [&](PointIndex from, PointIndex to) { return (p_[to] - p_[from]).normalized(); };
        const Eigen::Vector3f here =
            direction(back(i, direction_half, pass.first), ahead(i, direction_half, pass.last));
        const PointIndex near_back = back(i, run_near, pass.first);
        const PointIndex near_ahead = ahead(i, run_near, pass.last);
        const Eigen::Vector3f before = direction(back(near_back, run_far - run_near, pass.first), near_back);
        const Eigen::Vector3f after = direction(near_ahead, ahead(near_ahead, run_far - run_near, pass.last));
        return before.dot(after) > step_over_move_cosine && here.dot(before) < step_over_move_cosine &&
               here.dot(after) < step_over_move_cosine;
    }

    const Positions& p_;
    const ArcLength& arc_length_;
    float step_over_;
};

/// A loop or a spiral has completed a turn at a point whose neighbour is in the same piece: the piece is cut there, so that
/// every turn is a pass. Adds the moves from loop to loop to `step_over_moves`.
Passes cut_at_returns(const Passes& passes, const Adjacency& neighbours, const StepOverMoveFinder& finder,
                      std::vector<PointRange>& step_over_moves) {
    Passes turns;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) {
            turns.push_back(pass);
            continue;
        }
        PointIndex first = pass.first;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            const bool returned = [&] {
                for (const Side side : {Side::left, Side::right}) {
                    if (!neighbours.has(side, i)) continue;
                    const PointIndex n = neighbours.neighbour(side, i);
                    if (n >= first && n < i) return true;
                }
                return false;
            }();
            if (!returned) continue;
            const PointRange step_over_move = finder.step_over_move_at(i, {first, pass.last});
            if (step_over_move.size() > 0) step_over_moves.push_back(step_over_move);
            turns.push_back({first, i - 1, PassKind::cut});
            first = i;
        }
        turns.push_back({first, pass.last, PassKind::cut});
    }
    return turns;
}

void stitch_runs(ClSurface& surface, const Passes& runs, const ArcLength& arc_length, const CutOrder& order,
                 double step_over) {
    surface.step_over =
        step_over > 0 ? step_over : estimate_step_over(surface.positions, runs, arc_length, CutGroups(order, runs));
    surface.step_over_moves.clear();
    if (surface.step_over <= 0) {
        surface.passes = runs;
        surface.neighbours = find_neighbours(surface.positions, runs, arc_length, 0);
        return;
    }
    const Passes passes = find_passes(surface.positions, arc_length, runs, surface.step_over);
    surface.neighbours =
        find_neighbours(surface.positions, passes, arc_length, surface.step_over, CutGroups(order, passes));
    surface.passes =
        cut_at_returns(passes, surface.neighbours, StepOverMoveFinder(surface.positions, arc_length, surface.step_over),
                       surface.step_over_moves);
}

/// The runs again, without passes that are not finishing; counts their points.
Passes without_other_cutting(const ClSurface& surface, const Passes& runs, PointIndex& left_out) {
    const std::vector<bool> finishing = find_finishing_passes(surface);
    Passes rest;
    std::size_t k = 0;
    for (const Pass& run : runs) {
        if (run.kind != PassKind::cut) {
            append_pass(rest, run);
            continue;
        }
        PointIndex next = run.first;
        for (; k < surface.passes.size() && surface.passes[k].first <= run.last; ++k) {
            const Pass& pass = surface.passes[k];
            if (pass.kind != PassKind::cut || pass.last < run.first || finishing[k]) continue;
            append_pass(rest, {next, pass.first - 1, PassKind::cut});
            append_pass(rest, {pass.first, pass.last, PassKind::other});
            left_out += pass.size();
            next = pass.last + 1;
        }
        append_pass(rest, {next, run.last, PassKind::cut});
    }
    return rest;
}

}  // namespace

ClSurface stitch(Positions positions, const LineMap& lines, double step_over) {
    ClSurface surface;
    surface.positions = std::move(positions);
    const CutOrder order(lines);
    const Passes runs = cut_at_runs(find_runs(surface.positions, lines), order.runs);
    const ArcLength arc_length(surface.positions);
    stitch_runs(surface, runs, arc_length, order, step_over);
    if (surface.step_over <= 0) return surface;
    const Passes finishing = without_other_cutting(surface, runs, surface.not_finishing);
    if (surface.not_finishing > 0) stitch_runs(surface, finishing, arc_length, order, step_over);
    return surface;
}

void show_all_cutting(ClSurface& surface) {
    constexpr double few = 0.1;
    const PointIndex finishing = cutting_points(surface.passes);
    if (static_cast<double>(finishing) >= few * static_cast<double>(finishing + surface.not_finishing)) return;
    for (Pass& pass : surface.passes) {
        if (pass.kind == PassKind::other) pass.kind = PassKind::cut;
    }
    surface.not_finishing = 0;
    surface.step_over = 0;
    surface.step_over_moves.clear();
    for (Column<std::int32_t>* side : {&surface.neighbours.left, &surface.neighbours.right})
        std::fill(side->begin(), side->end(), Adjacency::none);
}

}  // namespace clsurf
