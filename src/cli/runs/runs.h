#pragma once
// The runs of `diff`: logs, or programs that are simulated.

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
    std::string program;                           ///< program of the logs; empty: their line channel is used
    Machine machine;                               ///< --machine, otherwise the default one
    std::shared_ptr<const Kinematics> kinematics;  ///< kinematics of --machine; nullptr: three axes
    Vec3 start = Vec3::Zero();
    FramePoses poses;    ///< --work-offset
    bool force = false;  ///< accept a log that does not belong to `program`
    ToolChoice tool;
    std::optional<Role> role;  ///< none: commanded positions if all runs have them
    DerivativeMethod derivative = DerivativeMethod::savgol;
};

/// --program, --machine, --start, --surface, --work-offset, --tool and the options for reading logs and programs.
void declare_runs(po::options_description& options);
[[nodiscard]] RunOptions read_run_options(const po::variables_map& values);

/// A log, and the program that was simulated or that --program names.
struct LoadedRun {
    std::string name;
    Log log;
    std::shared_ptr<const Program> program;  ///< simulated, or from --program; nullptr: none
    bool simulated = false;
    std::shared_ptr<const Kinematics> kinematics;            ///< nullptr: the log has the positions of three axes
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< machine = pose · compared positions
};

/// Loads a log or a program, distinguished by content. A program is simulated, on five axes if it and --machine have them.
/// Throws InputError: neither, or empty, or a machine with rotary axes that the log does not have. The log's diagnostics have
/// `path.rotary` if a rotary axis moves and no machine is given.
[[nodiscard]] LoadedRun load_run(const std::string& path, const RunOptions& options);

/// The positions by which two runs are compared: with --machine those of the tip. Throws InputError: they have none in
/// common.
[[nodiscard]] ComparedRun run_of(const LoadedRun& run, const LoadedRun& other, const RunOptions& options);

/// The lines of the points of a run. Without a program, all points cut unless the line channel marks them as idle. Reads
/// --program into `run`.
[[nodiscard]] std::unique_ptr<LineMap> lines_of(LoadedRun& run, const Trajectory& path, const RunOptions& options,
                                                Diagnostics& diagnostics);

/// state_tool_axes() of the program of a run, if it is known. `diagnostics`: nullptr: none are added.
void state_tool_axes(Trajectory& path, const LoadedRun& run, const LineMap& lines, Diagnostics* diagnostics);

}  // namespace clsurf::cli
