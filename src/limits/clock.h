#pragma once
// Steps between records that are not one period long: differences over them do not describe the machine.

#include <span>
#include <vector>

#include "log/log.h"

namespace clsurf {

struct ClockRules {
    double acceleration = 0;     ///< [mm/s²] greatest acceleration that a limit allows; 0: there is no limit
    double jerk = 0;             ///< [mm/s³] of the linear axes; 0: one of them has no limit
    double resolution = 0;       ///< of positions [mm]
    double time_resolution = 0;  ///< of the channel `time` [s]
};

/// The steps that lead to consecutive records.
struct StepClock {
    std::vector<char> broken;  ///< records are missing or repeated before this one, or the position jumps
    /// Delay of each record relative to a whole number of periods after the first one [s]; empty: there is no clock, or all
    /// steps are periods within its resolution.
    std::vector<double> late;
};

/// Judges the records [begin, begin + x.size()) with these positions [mm]. A step is broken if the clock shows it. Because
/// many clocks only count records, a step is also broken if the tool moves at least twice as far as in the adjacent
/// periods, or less than half as far, or if it is accelerated by more than 10 g and 20 times the limit. The same applies if
/// the jerk is more than three times its limit and would be within it if one to three records were lost there or one were
/// recorded twice. O(records).
[[nodiscard]] StepClock judge_steps(const Log& log, const ClockRules& rules, PointIndex begin,
                                    std::span<const double> x, std::span<const double> y, std::span<const double> z);

}  // namespace clsurf
