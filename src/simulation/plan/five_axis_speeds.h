#pragma once
// Speeds along a FiveAxisPath, from rest to rest: as fast as the limits of speed, acceleration and jerk of all five axes
// and the feed of the tip allow.
//
// A scan with a part of the accelerations gives first speeds, from which the cells are made. AxisSpeedProblem optimises
// the speeds in windows that end at rest. Most of a window is run, and the next window begins in the state where it
// stopped. Derivatives vary within a cell, at every rounded joint: if a solution exceeds a limit between the samples of its
// cells, it is corrected. Next to a rest v² is not a quadratic of u, and the jerk is constant. Only the chord error depends
// on the interpolation period.

#include <functional>
#include <vector>

#include "core/place.h"
#include "machine/machine.h"
#include "simulation/path/five_axis_path.h"
#include "simulation/plan/planned_motion.h"

namespace clsurf {

/// A section of the plan.
struct FiveAxisMotion {
    double begin = 0;     ///< u [mm]
    double duration = 0;  ///< [s]
    CellMotion cell;      ///< if the jerk is 0
    double jerk = 0;      ///< not 0: constant jerk, positive from rest, negative to rest
    LimitingFactor limit = LimitingFactor::none;

    /// u after a time [mm]; `speed`: output, its derivative there.
    [[nodiscard]] double at(double time, double& speed) const;
};

/// `place_of`: the line of a block, for errors. Throws InputError if no speeds satisfy the limits. O(chords).
[[nodiscard]] std::vector<FiveAxisMotion> plan_speeds(const FiveAxisPath& path, const Machine& machine,
                                                      const std::function<Place(std::size_t block)>& place_of);

}  // namespace clsurf
