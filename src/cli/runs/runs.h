#pragma once
// The runs of `diff`: logs, or programs that are simulated.

#include <optional>
#include <string>

#include "cli/options/known_tool.h"
#include "cli/options/options.h"
#include "machine/machine.h"
#include "pipeline/compare_runs.h"

namespace clsurf::cli {

struct RunOptions {
    io::ProgramOptions program_options;
    io::LogOptions log_options;
    std::string program;  ///< program of the logs; empty: their line channel is used
    Machine machine;      ///< --machine, otherwise the default one
    Vec3 start = Vec3::Zero();
    ToolChoice tool;
    std::optional<Role> role;  ///< none: commanded positions if all runs have them
    PlacingRules placing;      ///< --work-offset, kinematics of --machine, --derivative, --force; reads --program
};

/// --program, --machine, --start, --surface, --work-offset, --tool and the options for reading logs and programs.
void declare_runs(po::options_description& options);
[[nodiscard]] RunOptions read_run_options(const po::variables_map& values);

/// Loads a log or a program, distinguished by content. A program is simulated. Throws InputError: neither, or empty; what
/// placed_run() and simulate_run() throw (pipeline/placed_run.h).
[[nodiscard]] PlacedRun load_run(const std::string& path, const RunOptions& options);

/// How loaded runs are compared.
[[nodiscard]] ComparisonRules comparison_rules(const RunOptions& options);

}  // namespace clsurf::cli
