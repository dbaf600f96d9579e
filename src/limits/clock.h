#pragma once
// Steps between records that are no step of one period: differences over them say nothing about the machine.

#include <span>
#include <vector>

#include "log/log.h"

namespace clsurf {

struct ClockRules {
    double acceleration = 0;     ///< [mm/s²] the greatest that a limit allows; 0: none is stated
    double jerk = 0;             ///< [mm/s³] of the linear axes; 0: one of them has no limit
    double resolution = 0;       ///< of positions [mm]
    double time_resolution = 0;  ///< of the channel `time` [s]
};

/// Of consecutive records: what the step that leads to each of them is like.
struct StepClock {
    std::vector<char> broken;  ///< records are missing or repeated before this one, or the position jumps
    /// By how much each record is later than a whole number of periods after the first one [s]; empty: there is no clock, or
    /// its steps are periods as far as it shows.
    std::vector<double> late;
};

/// Records [begin, begin + x.size()) with these positions [mm]. A step is broken where the clock says so; and, as many
/// clocks are counters of records, where the tool moves twice as far in one period as in those beside it or farther, less
/// than half as far, or is accelerated by more than 10 g and 20 times the limit; and where the jerk is more than three times
/// its limit and would keep it if one to three records were lost there, or one were recorded twice. O(records).
[[nodiscard]] StepClock judge_steps(const Log& log, const ClockRules& rules, PointIndex begin,
                                    std::span<const double> x, std::span<const double> y, std::span<const double> z);

}  // namespace clsurf
