#pragma once
// The speeds along a FiveAxisPath: as fast as the limits of speed, acceleration and jerk of all five axes and the feed of
// the tip allow, from rest to rest.
//
// A scan with part of the accelerations gives first speeds, and they the cells. AxisSpeedProblem optimises them, in
// windows that end at rest; most of a window is run, and the next one begins in its state. Derivatives vary within a cell,
// with every rounded joint: where a solution breaks a limit between the samples of its cells, it is mended. Next to a
// rest, where v² is no quadratic of u, the jerk is constant. Nothing here knows the interpolation period but the chord error.

#include <functional>
#include <vector>

#include "core/place.h"
#include "machine/machine.h"
#include "simulation/path/five_axis_path.h"
#include "simulation/plan/planned_motion.h"

namespace clsurf {

/// A part of the plan.
struct FiveAxisMotion {
    double begin = 0;     ///< u [mm]
    double duration = 0;  ///< [s]
    CellMotion cell;      ///< without a jerk of its own
    double jerk = 0;      ///< otherwise: constant, from rest; less than 0: to rest
    LimitingFactor limit = LimitingFactor::none;

    /// u after a time [mm]; `speed`: its derivative there.
    [[nodiscard]] double at(double time, double& speed) const;
};

/// `place_of`: the line of a block, for errors. Throws InputError where nothing holds the limits. O(chords).
[[nodiscard]] std::vector<FiveAxisMotion> plan_speeds(const FiveAxisPath& path, const Machine& machine,
                                                      const std::function<Place(std::size_t block)>& place_of);

}  // namespace clsurf
