#pragma once
// Runs for `diff`: logs, or programs that are simulated, as they are compared.

#include <memory>
#include <optional>
#include <string>

#include "cli/options/known_tool.h"
#include "cli/options/options.h"
#include "compare/run_difference.h"
#include "log/log.h"
#include "machine/machine.h"
#include "mapping/line_map.h"
#include "program/frame_placement.h"
#include "program/program.h"

namespace clsurf::cli {

struct RunOptions {
    io::ProgramOptions program_options;
    io::LogOptions log_options;
    std::string program;                           ///< of logs; empty: their line channel is taken as it is
    Machine machine;                               ///< --machine, else the default one
    std::shared_ptr<const Kinematics> kinematics;  ///< of --machine; nullptr: three axes
    Vec3 start = Vec3::Zero();
    FramePoses poses;    ///< --work-offset
    bool force = false;  ///< go on with a log that does not belong to `program`
    ToolChoice tool;
    std::optional<Role> role;  ///< none: commanded where all runs have it
    DerivativeMethod derivative = DerivativeMethod::savgol;
};

/// --program, --machine, --start, --surface, --work-offset, --tool and what logs and programs need.
void declare_runs(po::options_description& options);
[[nodiscard]] RunOptions read_run_options(const po::variables_map& values);

/// A log, and the program if it was one that was simulated, as it was simulated.
struct LoadedRun {
    std::string name;
    Log log;
    std::shared_ptr<const Program> program;  ///< that was simulated, or --program; nullptr: none
    bool simulated = false;
    std::shared_ptr<const Kinematics> kinematics;            ///< nullptr: the log has the positions of three axes
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< machine = pose · what is compared
};

/// Told apart by content; a program is simulated, on five axes where it and --machine have them. Throws InputError:
/// neither, or empty, or a machine with rotary axes that the log does not have. The log's diagnostics have `path.rotary` where a
/// rotary axis moves and no machine is given.
[[nodiscard]] LoadedRun load_run(const std::string& path, const RunOptions& options);

/// Which positions two runs are compared by: with --machine those of the tip. Throws InputError: they have none in
/// common.
[[nodiscard]] ComparedRun run_of(const LoadedRun& run, const LoadedRun& other, const RunOptions& options);

/// What the points of a run belong to; without a program all that the line channel does not call idle cuts. Reads
/// --program into `run`.
[[nodiscard]] std::unique_ptr<LineMap> lines_of(LoadedRun& run, const Trajectory& path, const RunOptions& options,
                                                Diagnostics& diagnostics);

/// state_tool_axes() of the program of a run, where that is known. `diagnostics`: nullptr: it says nothing.
void state_tool_axes(Trajectory& path, const LoadedRun& run, const LineMap& lines, Diagnostics* diagnostics);

}  // namespace clsurf::cli
