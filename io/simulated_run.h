#pragma once
// A simulated run as a log in memory, for those who compare runs and need no file.

#include "core/progress.h"
#include "log/log.h"
#include "motion/simulator.h"

namespace clsurf::io {

/// Channels as those of `clsurf simulate`: cmd and fb positions, line. The log's diagnostics are the
/// program's and the run's. 56 bytes a point. Throws InputError as simulate() does.
[[nodiscard]] Log simulate_run(const Program& program, const Machine& machine, const Vec3& start,
                               const Progress& progress);

}  // namespace clsurf::io
