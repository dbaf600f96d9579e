#pragma once
// Levelling: the speeds that neighbour passes can all hold. Where a run shows a pass faster than the one
// beside it, its lines get a feed that brings both together.

#include <cstdint>
#include <vector>

#include "optimize/ramp.h"
#include "optimize/run.h"
#include "surface/station.h"

namespace clsurf {

/// The speed of each point of a run that is compared with the passes beside it [mm/s]; NaN elsewhere.
[[nodiscard]] std::vector<float> compared_speeds(const JudgedRun& run);

/// How much faster than the pass beside it a place may be: by a share of that one's speed and by a speed.
struct LevelStep {
    double share = 0;
    double speed = 0;  ///< [mm/s]
    Ramp ramp{};       ///< … and how a pass comes back to its own speed
};

/// Speeds on their way to be levelled; all have one entry a point.
struct Levelling {
    std::vector<float> speeds;         ///< [mm/s]
    std::vector<std::int32_t> causes;  ///< what a point is lowered for, ≥ 0; −1: nothing
    /// 1: is to be level with what lies beside it. Where neither of two points is, they may differ by as large a share as they did: beside
    /// a lowered place there may be another slow one, which is not to be levelled with it.
    std::vector<std::uint8_t> levelled;
};

/// Brings the speeds of a run down to what the passes beside each other and the ramps allow. Any number of times: it keeps what
/// lies beside each point. The run must outlive it. May be used by several threads.
class Leveller {
public:
    /// O(points)
    explicit Leveller(const JudgedRun& run);

    /// compared_speeds() of the run
    [[nodiscard]] const std::vector<float>& own() const { return own_; }

    /// Lowers speeds, one a point of the run, until none is more than a step above that of the points beside it on
    /// both neighbour passes. Only points that have a cause, or have one beside them, are lowered, and take over
    /// the cause: where all begin with one, speeds are levelled everywhere. Before and behind a lowered place a pass keeps to the
    /// ramp, so that the next one is levelled with what the machine will do. Two sweeps, forth and back, over the passes that have a
    /// cause, or one beside them.
    void level(const LevelStep& step, Levelling& levelling) const;

    /// The greatest speeds that are level everywhere.
    [[nodiscard]] std::vector<float> everywhere(const LevelStep& step) const;

    /// The least step [mm/s] to which all can be levelled so that no more than `budget` [s] is lost. Ten levellings: O(points).
    [[nodiscard]] double affordable_step(const Ramp& ramp, double budget) const;

    /// What the run would take longer at such speeds [s], by the points' own times.
    [[nodiscard]] double lost(const std::vector<float>& speeds) const;

private:
    struct Beside {
        Station left, right;
    };

    const JudgedRun& run_;
    std::vector<float> own_;
    std::vector<Beside> beside_;                           ///< one entry a point
    std::vector<std::vector<std::size_t>> passes_beside_;  ///< per pass, those that its points have beside them
};

/// The greatest over the points of each motion of the program, of one value per point; NaN: it has no point with one. As a feed it
/// holds a motion to a curve that rises or falls along it; the mean would hold it below.
[[nodiscard]] std::vector<float> peaks_by_motion(const JudgedRun& run, const Program& program,
                                                 const std::vector<float>& values);

/// Feeds that hold motions to a target [mm/s]; targets and feeds of 0: none. Motions whose entry in `may_slow` is 0 get none;
/// empty: all may. Neighbouring motions with a feed form constant-speed intervals, inside which targets differ by less
/// than `width` (a share); each has the lowest of them.
[[nodiscard]] std::vector<float> levelling_feeds(const std::vector<float>& target,
                                                 const std::vector<std::uint8_t>& may_slow, double width);

}  // namespace clsurf
