#pragma once
// Health: can a log be trusted? Every finding is a diagnostic with a place and a number.

#include "log/log.h"

namespace clsurf {

/// Between records [s]; a speed is a fit over five of them, and marks last some hundredths of a second.
inline constexpr double longest_judged_period = 0.020;

/// Findings of one pass over the records (O(records · channels), parallel):
/// - log.time-gap, log.time-back: records lost, a clock that goes back or stands still
/// - log.jitter: the clock's steps differ by more than 5 % of a period, rms
/// - log.jump: a step in position that no machine makes
/// - log.missing-value: NaN
/// - log.far: a position that no machine reaches
/// - log.line-range, log.line-wild, log.line-stuck: line numbers that the program does not have, that
///   flicker for one record, or that stay while the tool goes to and fro
/// - log.still: an axis without motion (a warning where its commanded position moves)
///
/// Findings of samples spread over the log:
/// - log.period: the clock's step is not the stated period
/// - log.offset: feedback differs from commanded by a constant, which is no lag
/// - log.quantum: positions come in steps
///
/// Findings that make marks invisible (`check` does not judge then):
/// - log.coarse: records come too seldom
/// - log.placeholder: a position that stands where none was recorded
///
/// And log.missing-channel, log.empty. `program_lines`: lines of the program that ran, 0: not known.
[[nodiscard]] Diagnostics check_health(const Log& log, LineNumber program_lines);

}  // namespace clsurf
