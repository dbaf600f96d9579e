#pragma once
// Runs for `diff`: logs, or programs that are simulated, as they are compared.

#include <memory>
#include <optional>
#include <string>

#include "cli/known_tool.h"
#include "cli/options.h"
#include "log/log.h"
#include "path/line_map.h"
#include "program/frame_placement.h"
#include "program/program.h"
#include "quality/run_difference.h"

namespace clsurf::cli {

struct RunOptions {
    io::ProgramOptions program_options;
    io::LogOptions log_options;
    std::string program;  ///< of logs; empty: their line channel is taken as it is
    std::string machine;  ///< file; empty: the default one
    Vec3 start = Vec3::Zero();
    FramePoses poses;    ///< --work-offset
    bool force = false;  ///< go on with a log that does not belong to `program`
    ToolChoice tool;
    std::optional<Role> role;  ///< none: commanded where all runs have it
};

/// --program, --machine, --start, --surface, --work-offset, --tool and what logs and programs need.
void declare_runs(po::options_description& options);
[[nodiscard]] RunOptions read_run_options(const po::variables_map& values);

/// A log, and the program if it was one that was simulated.
struct LoadedRun {
    std::string name;
    Log log;
    std::shared_ptr<const Program> program;  ///< that was simulated, or --program; nullptr: none
    bool simulated = false;
};

/// Told apart by content. Throws InputError: neither, or empty.
[[nodiscard]] LoadedRun load_run(const std::string& path, const RunOptions& options);

/// Which positions two runs are compared by. Throws InputError: they have none in common.
[[nodiscard]] ComparedRun run_of(const LoadedRun& run, const LoadedRun& other, const RunOptions& options);

/// What the points of a run belong to; without a program all that the line channel does not call idle cuts. Reads
/// --program into `run`.
[[nodiscard]] std::unique_ptr<LineMap> lines_of(LoadedRun& run, const Trajectory& path, const RunOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace clsurf::cli
