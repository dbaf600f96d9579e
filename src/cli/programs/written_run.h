#pragma once
// A program simulated into a log file, point by point.

#include <string>

#include "cli/options/options.h"
#include "core/diagnostic.h"
#include "machine/machine.h"
#include "simulation/run/five_axis_simulator.h"

namespace clsurf::cli {

struct WrittenRun {
    FiveAxisSummary summary;  ///< on three axes `run` alone
    bool five_axes = false;
    Diagnostics diagnostics;
};

/// Runs PROGRAM of the options on a machine and writes its log. Throws UsageError, InputError, SystemError.
[[nodiscard]] WrittenRun write_run(const Machine& machine, const std::string& output, const po::variables_map& values);

}  // namespace clsurf::cli
