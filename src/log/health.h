#pragma once
// Health: can a log be trusted? One pass over the raw channels; every finding is a diagnostic with a
// point and a number.

#include "log/log.h"

namespace clsurf {

/// Findings (codes): log.time-gap, log.time-back, log.jitter, log.jump, log.missing-value,
/// log.missing-channel, log.stuck-line, log.line-range, log.offset, log.quantum, log.still.
/// `program_lines`: lines of the program it ran, 0: not known. O(records), parallel.
[[nodiscard]] Diagnostics check_health(const Log& log, std::uint32_t program_lines);

}  // namespace clsurf
