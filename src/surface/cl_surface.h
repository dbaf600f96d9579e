#pragma once
// ClSurface: the cutter-location surface, rebuilt from the tool path: passes, and for each point its neighbours on
// both adjacent passes. It is the source of the drawn mesh, of the measured differences, and of the normal along
// which a lag becomes a depth.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "surface/adjacency.h"
#include "surface/passes.h"
#include "toolpath/positions.h"

namespace clsurf {

struct ClSurface {
    Positions positions;
    Passes passes;  ///< cut at reversals of direction, and at returns to themselves (a turn of a spiral is one pass)
    std::vector<PointRange> step_over_moves;  ///< moves from one closed loop to the next, in order
    Adjacency neighbours;
    double step_over = 0;  ///< [mm]; 0: a single pass, no neighbours
    /// Cutting points that belong to no finishing pass (surface/finishing.h); in `passes` they count as rapid.
    PointIndex not_finishing = 0;
    /// Earlier measurements, for a surface that is read only in part; else empty.
    std::optional<double> cut_length;                ///< [mm] of all cut passes
    std::vector<bool> low_links;                     ///< by pass: stays_low() (machined/contact_points.h)
    std::vector<Eigen::AlignedBox3f> boxes;          ///< [mm] of the positions shown and measured, by block
    std::vector<Eigen::AlignedBox3f> surface_boxes;  ///< [mm] of the positions of passes and links, by block
};

/// Arc length of all cut passes [mm]. O(passes).
[[nodiscard]] inline double cut_arc_length(const ClSurface& surface, const ArcLength& arc_length) {
    if (surface.cut_length) return *surface.cut_length;
    double sum = 0;
    for (const Pass& pass : surface.passes) {
        if (pass.kind == PassKind::cut) sum += arc_length.to(pass.last) - arc_length.to(pass.first);
    }
    return sum;
}

/// Splits ascending ranges into parts between and inside step-over moves.
class StepOverMoveCutter {
public:
    /// `step_over_moves` must outlive it.
    explicit StepOverMoveCutter(std::span<const PointRange> step_over_moves) : step_over_moves_(step_over_moves) {}

    /// Calls f(part, whether it is a step-over move) for the next range. Amortised O(parts).
    template <typename F>
    void cut(PointRange range, F&& f) {
        for (; next_ < step_over_moves_.size() && step_over_moves_[next_].first <= range.last; ++next_) {
            const PointRange& step_over_move = step_over_moves_[next_];
            if (step_over_move.first > range.first) f(PointRange{range.first, step_over_move.first - 1}, false);
            const PointRange inside{std::max(range.first, step_over_move.first),
                                    std::min(range.last, step_over_move.last)};
            if (inside.size() > 0) f(inside, true);
            range.first = std::max(range.first, inside.last + 1);
            if (step_over_move.last > range.last) return;  // continues in the next range
        }
        if (range.size() > 0) f(range, false);
    }

private:
    std::span<const PointRange> step_over_moves_;
    std::size_t next_ = 0;
};

}  // namespace clsurf
