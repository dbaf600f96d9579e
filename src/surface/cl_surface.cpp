#include "surface/cl_surface.h"

#include <utility>

#include "path/step_over.h"

namespace clsurf {
namespace {

/// A loop or a spiral has come round where its neighbour lies in the same piece: there the piece
/// is cut, so that every turn is a pass.
Passes cut_at_returns(const Passes& passes, const Adjacency& neighbours) {
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
            turns.push_back({first, i - 1, PassKind::cut});
            first = i;
        }
        turns.push_back({first, pass.last, PassKind::cut});
    }
    return turns;
}

}  // namespace

ClSurface stitch(Positions positions, const LineMap& lines, double step_over) {
    ClSurface surface;
    surface.positions = std::move(positions);
    const Passes runs = find_runs(surface.positions, lines);
    const Way way(surface.positions);
    surface.step_over = step_over > 0 ? step_over : estimate_step_over(surface.positions, runs, way);
    if (surface.step_over <= 0) {
        surface.passes = runs;
        surface.neighbours = find_neighbours(surface.positions, runs, way, 0);
        return surface;
    }
    const Passes passes = find_passes(surface.positions, way, runs, surface.step_over);
    surface.neighbours = find_neighbours(surface.positions, passes, way, surface.step_over);
    surface.passes = cut_at_returns(passes, surface.neighbours);
    return surface;
}

}  // namespace clsurf
