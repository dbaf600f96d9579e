#pragma once
// The constant-speed intervals of a whole program. Each pass is divided. The speed of each interval follows
// from its curvature, the machine, and the intervals on the adjacent passes.

#include <vector>

#include "intervals/intervals.h"
#include "surface/programmed_surface.h"

namespace clsurf {

struct ProgramInterval {
    std::int64_t pass = 0;  ///< number of the cut pass, from 1
    LineNumber first_line = 0, last_line = 0;
    double length = 0;                                  ///< [mm]
    double mean_curvature = 0, greatest_curvature = 0;  ///< [1/mm]
    double feed = 0;                                    ///< [mm/s] lowest programmed feed
    double own_speed = 0;  ///< [mm/s] greatest speed that feed, curvature and machine allow
    double speed = 0;      ///< [mm/s] planned, with short intervals and neighbours considered
};

struct ProgramIntervals {
    std::vector<ProgramInterval> intervals;  ///< in the order of the program
    std::vector<float> speed_of_motion;      ///< [mm/s] planned; NaN: not on a cut pass
    std::int64_t passes = 0;
    double step_over = 0;  ///< [mm]; 0: no neighbours
};

/// An interval that is faster than the previous and the next one and too short for a change of speed gets the higher speed
/// of both. Adjacent intervals whose speeds differ by less than 15 % get the lower speed, in two sweeps over the passes,
/// forward and backward. O(points log points).
[[nodiscard]] ProgramIntervals plan_intervals(const Program& program, const ProgrammedSurface& programmed,
                                              const IntervalRules& rules, const Machine& machine);

}  // namespace clsurf
