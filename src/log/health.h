#pragma once
// Health: can a log be trusted? Every finding is a diagnostic with a place and a number.

#include "log/log.h"

namespace clsurf {

/// Period between records [s]: a speed is a fit over five of them, and marks last some hundredths of a second.
inline constexpr double longest_judged_period = 0.020;

/// Findings of one pass over the records (O(records · channels), parallel):
/// - log.time-gap, log.time-back: records lost, a clock that goes back or stops
/// - log.jitter: the clock's steps differ by more than 5 % of a period, rms
/// - log.jump: a step in position that is impossible for a machine
/// - log.missing-value: NaN
/// - log.far: a position beyond the travel of any machine
/// - log.line-range, log.line-wild, log.line-stuck: line numbers that the program does not have, that
///   flicker for one record, or that stay the same while the tool moves back and forth
/// - log.still: an axis without motion (a warning if its commanded position moves)
///
/// Findings from samples spread over the log:
/// - log.period: the clock's step differs from the stated period
/// - log.offset: feedback differs from commanded by a constant, not by a lag
/// - log.quantum: positions come in steps
///
/// Findings that make marks invisible (`check` does not judge then):
/// - log.coarse: the period is too long
/// - log.placeholder: a substitute for a position that was not recorded
///
/// And log.missing-channel, log.empty. `program_lines`: lines of the program that ran, 0: unknown.
[[nodiscard]] Diagnostics check_health(const Log& log, LineNumber program_lines);

}  // namespace clsurf
