#pragma once
// Simulates a program into a log file, point by point.

#include <string>

#include "cli/options/options.h"
#include "core/diagnostic.h"
#include "machine/machine.h"
#include "simulation/run/five_axis_simulator.h"

namespace clsurf::cli {

struct WrittenRun {
    FiveAxisSummary summary;  ///< on three axes, only `run` is set
    bool five_axes = false;
    Diagnostics diagnostics;
};

/// Runs PROGRAM of the options on a machine and writes the log. Throws UsageError, InputError, SystemError.
[[nodiscard]] WrittenRun write_run(const Machine& machine, const std::string& output, const po::variables_map& values);

}  // namespace clsurf::cli
