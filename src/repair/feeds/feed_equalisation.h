#pragma once
// Feed equalisation: speeds that all adjacent passes can keep. If a pass is faster than the adjacent one, its lines get a feed
// that makes both equal.

#include <cstdint>
#include <vector>

#include "repair/feeds/ramp.h"
#include "repair/judged_run.h"
#include "surface/path_location.h"

namespace clsurf {

/// The speed of each point of a run that is compared with the adjacent passes [mm/s]; NaN elsewhere.
[[nodiscard]] std::vector<float> compared_speeds(const JudgedRun& run);

/// The permitted difference of speed to the adjacent pass: a fraction of its speed plus a speed.
struct EqualisationStep {
    double share = 0;
    double speed = 0;  ///< [mm/s]
    Ramp ramp{};       ///< … and the return of a pass to its own speed
};

/// Speeds during equalisation; one entry per point in each column.
struct FeedEqualisation {
    std::vector<float> speeds;         ///< [mm/s]
    std::vector<std::int32_t> causes;  ///< index ≥ 0 of the reason why a point is slowed; −1: none
    /// 1: to be equalised with the adjacent points. Between two points that are both 0, their original relative difference may
    /// remain, because another slow place next to a lowered one must not determine its speed.
    std::vector<std::uint8_t> equalised;
};

/// Lowers the speeds of a run to what adjacent passes and the ramps allow. Reusable, because it stores the neighbours of each
/// point. The run must outlive it. Thread-safe.
class FeedEqualiser {
public:
    /// O(points)
    explicit FeedEqualiser(const JudgedRun& run);

    /// compared_speeds() of the run
    [[nodiscard]] const std::vector<float>& own() const { return own_; }

    /// Lowers speeds, one per point of the run, until none exceeds that of its neighbours on both adjacent passes by more than
    /// a step. Only points with a cause, or with a neighbour that has one, are lowered, and they take over the cause; if all
    /// start with one, speeds are equalised everywhere. Before and after a lowered place a pass follows the ramp, so the next
    /// pass is equalised with the real motion of the machine. Two sweeps, forward and backward, over the passes with a cause or
    /// adjacent to one.
    void equalise(const EqualisationStep& step, FeedEqualisation& equalisation) const;

    /// The highest speeds that are equal everywhere.
    [[nodiscard]] std::vector<float> everywhere(const EqualisationStep& step) const;

    /// The smallest step [mm/s] to which all speeds can be equalised without losing more than `budget` [s]. Ten
    /// equalisations: O(points).
    [[nodiscard]] double affordable_step(const Ramp& ramp, double budget) const;

    /// The additional time of the run at such speeds [s], by the times of the points.
    [[nodiscard]] double lost(const std::vector<float>& speeds) const;

private:
    struct AdjacentLocations {
        PathLocation left, right;
    };

    const JudgedRun& run_;
    std::vector<float> own_;
    std::vector<AdjacentLocations> adjacent_;                ///< one entry per point
    std::vector<std::vector<std::size_t>> adjacent_passes_;  ///< per pass, the passes adjacent to its points
};

/// The maximum of the values over the points of each motion of the program; NaN: it has no point with a value. A motion between
/// the lines of two consecutive points was traversed within one period, or merged with the next one by the controller, and gets
/// the larger value of both. As a feed, the maximum lets a motion follow a curve that rises or falls along it; the mean would
/// be too low.
[[nodiscard]] std::vector<float> peaks_by_motion(const JudgedRun& run, const Program& program,
                                                 const std::vector<float>& values);

/// Targets of blocks, from those of peaks_by_motion(): motions that the controller merges (merged_with_next()) share their
/// highest target. 0: none. `merged` may be empty: none are merged.
[[nodiscard]] std::vector<float> block_targets(std::vector<float> targets, const std::vector<std::uint8_t>& merged);

/// Feeds that limit motions to a target [mm/s]; targets and feeds of 0: none. Motions whose entry in `may_slow` is 0 get none;
/// empty: all may. Consecutive motions with a feed form constant-speed intervals, in which targets differ by less than `width`
/// (a fraction). Each interval gets its lowest target.
[[nodiscard]] std::vector<float> equalised_feeds(const std::vector<float>& target,
                                                 const std::vector<std::uint8_t>& may_slow, double width);

}  // namespace clsurf
