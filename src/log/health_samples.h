#pragma once
// Checks of check_health() on samples spread over the log.

#include "log/log.h"

namespace clsurf {

/// log.offset: feedback minus commanded while the machine is at rest; if it never is, the part of the difference that
/// does not depend on the speed.
void check_offset(const Log& log, Diagnostics& found);

/// log.quantum: the step of each axis, if nearly all differences are whole multiples of it.
void check_quantum(const Log& log, Diagnostics& found);

/// Adds log.placeholder, for each role that has x, y and z. O(records), parallel.
void check_placeholders(const Log& log, Diagnostics& found);

}  // namespace clsurf
