#pragma once
// LookaheadWindow: which part of the path a controller knows when it plans, and how much of it is run before it plans
// again.

#include <algorithm>
#include <cstdint>
#include <limits>

#include "machine/machine.h"
#include "simulation/path/path_stream.h"

namespace clsurf {

class LookaheadWindow {
public:
    /// `blocks`: greatest number of known blocks after the running one.
    LookaheadWindow(const ControllerSettings& controller, std::int64_t blocks)
        : blocks_(blocks),
          replan_blocks_(controller.replan_blocks),
          distance_(controller.lookahead_distance > 0 ? controller.lookahead_distance
                                                      : std::numeric_limits<double>::infinity()) {}

    /// Counts the spans that are known already. O(spans), no more than planning them takes.
    template <typename Spans>
    void begin(const Spans& spans) {
        ahead_ = 0;
        for (const Span& span : spans) count(spans.front(), span);
    }
    /// Adds a span to the known ones.
    void count(const Span& front, const Span& span) {
        if (span.base.block != front.base.block) ahead_ += span.length;
    }
    /// Whether another span may become known; `back`: the last known one.
    [[nodiscard]] bool takes_more(const Span& front, const Span& back) const {
        return back.base.block - front.base.block < blocks_ && ahead_ < distance_;
    }
    /// The number of the first block that is not run before the next plan.
    [[nodiscard]] std::int64_t first_kept(const Span& front, const Span& back) const {
        const std::int64_t known = std::min(blocks_, back.base.block - front.base.block);
        const std::int64_t run = replan_blocks_ > 0 ? replan_blocks_ : known / 2;
        return front.base.block + std::max<std::int64_t>(1, run);
    }

private:
    std::int64_t blocks_, replan_blocks_;
    double distance_;
    double ahead_ = 0;  ///< known path after the first block [mm]
};

}  // namespace clsurf
