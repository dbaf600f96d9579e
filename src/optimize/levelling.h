#pragma once
// Levelling: the speeds that neighbour passes can all hold. Where a run shows a pass faster than the one
// beside it, its lines get a feed that brings both together.

#include <cstdint>
#include <vector>

#include "optimize/run.h"

namespace clsurf {

/// For each point of a run the greatest speed [mm/s] that is at most its own and nowhere more than
/// (1 + step) times that of the points beside it on both neighbour passes; NaN where a point is not
/// compared. Two sweeps over the passes, forth and back: O(points).
[[nodiscard]] std::vector<float> levelled_speeds(const JudgedRun& run, double step);

/// The means over the points of each motion of the program, of one value per point; NaN: it has no point with one.
[[nodiscard]] std::vector<float> means_by_motion(const JudgedRun& run, const Program& program, const std::vector<float>& values);

/// Feeds that bring motions from their own speed down to a target [mm/s]; 0: the motion is slow enough.
/// Motions whose entry in `may_slow` is 0 get none; empty: all may. Neighbouring motions with a feed form constant-speed intervals, inside which targets differ by less than `width`
/// (a share); each has the lowest of them.
[[nodiscard]] std::vector<float> levelling_feeds(const std::vector<float>& own, const std::vector<float>& target, const std::vector<std::uint8_t>& may_slow, double play, double width);

}  // namespace clsurf
