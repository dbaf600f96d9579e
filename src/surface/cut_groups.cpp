#include "surface/cut_groups.h"

#include <algorithm>

namespace clsurf {

CutGroups::CutGroups(const CutOrder& order, const Passes& passes) {
    if (order.lines == nullptr || (order.runs.size() < 2 && order.lines->one_tool())) return;
    runs_ = order.runs;
    of_pass_.resize(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k) {
        OfPass& pass = of_pass_[k];
        const auto next = std::upper_bound(runs_.begin(), runs_.end(), passes[k].first,
                                           [](PointIndex point, const ProgramRun& run) { return point < run.first; });
        pass.run = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(0, next - runs_.begin() - 1));
        pass.first = order.lines->motion_at(passes[k].first);
        pass.last = order.lines->motion_at(passes[k].last);
        pass.tool = order.lines->tool_of(pass.first);
    }
}

}  // namespace clsurf
