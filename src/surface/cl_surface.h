#pragma once
// ClSurface: the cutter-location surface, rebuilt from the tool path: passes, and for each point its
// neighbours on both adjacent passes. The drawn mesh, the measured mismatch and the normal that turns a lag
// into a depth all come from it.

#include <algorithm>
#include <span>
#include <vector>

#include "surface/adjacency.h"
#include "surface/passes.h"
#include "toolpath/positions.h"

namespace clsurf {

struct ClSurface {
    Positions positions;
    Passes passes;                 ///< by turns back and by returning to themselves (a turn of a spiral is one)
    std::vector<PointRange> jogs;  ///< steps sideways from one closed loop to the next, in order
    Adjacency neighbours;
    double step_over = 0;  ///< [mm]; 0: a single pass, no neighbours
    /// Points that cut and belong to no finishing pass (surface/finishing.h); among the passes they count as rapid.
    PointIndex not_finishing = 0;
};

/// The parts of ranges, which rise, between steps sideways and inside them.
class JogCutter {
public:
    /// `jogs` must outlive it.
    explicit JogCutter(std::span<const PointRange> jogs) : jogs_(jogs) {}

    /// f(part, whether it is a step sideways) for the next range. Amortised O(parts).
    template <typename F>
    void cut(PointRange range, F&& f) {
        for (; next_ < jogs_.size() && jogs_[next_].first <= range.last; ++next_) {
            const PointRange& jog = jogs_[next_];
            if (jog.first > range.first) f(PointRange{range.first, jog.first - 1}, false);
            const PointRange inside{std::max(range.first, jog.first), std::min(range.last, jog.last)};
            if (inside.size() > 0) f(inside, true);
            range.first = std::max(range.first, inside.last + 1);
            if (jog.last > range.last) return;  // goes on in the next range
        }
        if (range.size() > 0) f(range, false);
    }

private:
    std::span<const PointRange> jogs_;
    std::size_t next_ = 0;
};

/// Stitches the runs of a trajectory into a surface; what is no finishing pass is left out. `step_over` [mm], 0: estimated. O(points).
[[nodiscard]] ClSurface stitch(Positions positions, const LineMap& lines, double step_over = 0);

}  // namespace clsurf
