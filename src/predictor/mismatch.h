#pragma once
// Mismatch: how a place of a pass differs from the adjacent places on the adjacent passes.
//
// Each quantity has two measures. The *step* is the largest difference to the two adjacent passes, minus the trend that
// continues to the passes beyond them. It shows on the part. The *residual* is the difference to the median over up to five
// passes on each side. It shows which of two passes causes the step, and it is zero where all passes change together.
// Accelerations are compared as vectors in workpiece coordinates, because along the path one pass of a zigzag brakes where the
// next one accelerates.

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "predictor/compared.h"

namespace clsurf {

/// Speeds relative to the neighbours' speed, accelerations [mm/s²], heights [mm].
struct Comparison {
    std::array<float, quantities> step;           ///< ≥ 0; NaN: not known
    std::array<float, quantities> lesser_step{};  ///< the smaller step of the two sides: zero at the edge of a band
    std::array<float, quantities> residual;       ///< signed; of the acceleration the length; NaN: not known
    std::array<float, quantities> uncertainty{};  ///< of the step, because log and place may be one period apart
    std::array<float, quantities> slack{};  ///< of step and residual, because passes end at slightly different places
    float speed_jump = 0;                   ///< residual of the speed [mm/s]
    int left = 0, right = 0;                ///< numbers of passes with which it was compared
    bool ramp = false;  ///< it is in the ramp of its pass, of an adjacent pass, or of the next one with its direction
    PathLocation adjacent_left, adjacent_right;  ///< on the adjacent passes
};

class Comparer {
public:
    // As in docs/design/predictor.md#1-compare-adjacent-passes, Residual.
    static constexpr int passes_aside = 5;

    /// Both must outlive it. `least_speed` [mm/s]: differences of lower speeds are relative to it.
    Comparer(const ClSurface& surface, const Signals& signals, float least_speed)
        : surface_(surface), signals_(signals), least_speed_(least_speed) {}

    [[nodiscard]] const ClSurface& surface() const { return surface_; }

    /// O(1): up to `aside` passes on each side. If `aside` is 1, steps are the same, but residuals mean little.
    [[nodiscard]] Comparison compare(const PathLocation& here, int aside = passes_aside) const;

    /// Comparison with the passes of the same direction of travel, for places where all passes begin or end. They end at
    /// slightly different places, and change fast there: the change of all of them within half a step-over is slack.
    [[nodiscard]] Comparison compare_at_end(const PathLocation& here) const;

    /// If the passes around a place do the same as it one after the other, its motion is also compared along their obliquity
    /// (oblique_alignment.h), and so is its relief in corners. The lesser of both differences counts.
    void compare_obliquely_around(const PathLocation& here, Comparison& comparison) const;

private:
    /// What a place is compared with: all passes, or only those with the same direction of travel (in a zigzag every second
    /// one).
    enum class Peers : std::uint8_t { all, same_direction };

    [[nodiscard]] Comparison compare_with(Peers peers, const PathLocation& here, int aside) const;

    /// How much each quantity changes along the pass within half a step-over; speeds over `reference`.
    [[nodiscard]] std::array<float, quantities> change_nearby(PointIndex point, float reference) const;

    const ClSurface& surface_;
    const Signals& signals_;
    float least_speed_;
};

/// The step above which a place is a discontinuity, per quantity, and the statistics behind it.
struct Thresholds {
    std::array<float, quantities> of{};
    std::array<float, quantities> median{};  ///< of the steps
    std::array<float, quantities> spread{};  ///< robust standard deviation of the steps
    std::array<float, quantities> p99{};     ///< 99th percentile of the steps
    float usual_speed = 0;                   ///< [mm/s] 95th percentile of the judged points
    float least_speed = 0;                   ///< [mm/s] differences of lower speeds are relative to this
    float usual_acceleration = 0;            ///< [mm/s²] 99th percentile
};

/// The numbers of docs/design/predictor.md#2-apply-thresholds.
struct ThresholdRule {
    float speed = 0.03F;  ///< least threshold, relative to the neighbours' speed
    float acceleration =
        0.15F;  ///< least threshold, relative to the usual acceleration; at least the effect of rounding (as for the speed),
                ///< and at least the acceleration of a sharp change of the speed by its least threshold
    float least_speed = 0.25F;  ///< share of the usual speed; more if rounding alone reaches the threshold there
    /// Least threshold of heights: in mm, and in steps of the positions. A whole pass may be rounded in one direction, and a
    /// relief depends on three passes.
    float height = 0.0015F, normal_deviation_quanta = 1.5F, relief_quanta = 2.4F;
    float spreads = 6;               ///< above the median; the usual scatter of a part is no defect …
    float acceleration_spreads = 9;  ///< (the length of a noise vector has a longer tail)
    float most = 3;  ///< … but at most this multiple of the least threshold, so that a bad part is detected
};

/// Thresholds from some 50,000 evenly spaced judged points. The same for any number of threads. `forget`: called from time to
/// time to forget signals that are derived when they are read; nothing: signals stay in memory.
[[nodiscard]] Thresholds measure_thresholds(const ClSurface& surface, const Signals& signals, const ThresholdRule& rule,
                                            const std::function<void()>& forget = {});

}  // namespace clsurf
