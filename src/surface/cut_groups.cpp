#include "surface/cut_groups.h"

#include <algorithm>

#include "core/point_ranges.h"

namespace clsurf {

Passes cut_at_runs(const Passes& pieces, std::span<const ProgramRun> runs) {
    if (runs.size() < 2) return pieces;
    Passes result;
    for (Pass piece : pieces) {
        for (const ProgramRun& run : runs.subspan(1)) {
            if (piece.kind != PassKind::cut || run.first <= piece.first || run.first > piece.last) continue;
            append_pass(result, {piece.first, run.first - 2, PassKind::cut});
            append_pass(result, {run.first - 1, run.first - 1, PassKind::link});
            piece.first = run.first;
        }
        append_pass(result, piece);
    }
    return result;
}

CutGroups::CutGroups(const CutOrder& order, const Passes& passes) {
    if (order.lines == nullptr || (order.runs.size() < 2 && order.lines->one_tool())) return;
    runs_ = order.runs;
    of_pass_.resize(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k) {
        OfPass& pass = of_pass_[k];
        // A pass may begin some points before its run.
        const auto run = range_at(runs_, passes[k].last);
        pass.run = static_cast<std::uint32_t>(run - runs_.begin());
        pass.first = order.lines->motion_at(std::max(passes[k].first, run->first));
        pass.last = order.lines->motion_at(passes[k].last);
        pass.tool = order.lines->tool_of(pass.first);
    }
}

}  // namespace clsurf
