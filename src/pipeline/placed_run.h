#pragma once
// PlacedRun: a run that is compared with other runs of the part. It is known how the positions of its log become positions on
// the part, but not yet which of them are compared: both runs of a comparison need the same kind (roles.h).

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/part.h"

namespace clsurf {

/// The program of a log, with its motions as programmed (io::ProgramOptions::coordinates empty). Its diagnostics include those
/// of its identity.
struct ProgramOfLog {
    Program program;
    ProgramIdentity identity = ProgramIdentity::unknown;
};

/// How runs become positions on the part.
struct PlacingRules {
    FramePoses poses;                              ///< pose of the program's zero, in all runs
    std::shared_ptr<const Kinematics> kinematics;  ///< of a machine with rotary axes; nullptr: three axes
    DerivativeMethod derivative = DerivativeMethod::savgol;
    bool accept_foreign = false;  ///< a log of another program is a warning, not an error
    /// The program of a log, which is read when it is needed. Empty: lines are those of the channel `line`.
    std::function<ProgramOfLog(const Log&)> program_of;
};

/// The lines of the points of a run.
struct RunLines {
    std::shared_ptr<const LineMap> map;
    std::shared_ptr<const Program> program;  ///< in the coordinates of the path; nullptr: not needed, or not known
    bool known = false;                      ///< false: the map only says what cuts
};

struct PlacedRun {
    std::string name;  ///< in messages
    Log log;
    std::shared_ptr<const Program> simulated;      ///< in the coordinates of the log; nullptr: the run was recorded
    std::shared_ptr<const Kinematics> kinematics;  ///< nullptr: positions are those of three axes
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< machine = pose · positions on the part
    DerivativeMethod derivative = DerivativeMethod::savgol;
    std::optional<CuttingTool> tool;  ///< nullopt: not known, or not yet (ComparisonRules)
    /// Positions of one role, if they are known: those of other roles are placed like them, whatever the pose.
    std::optional<Trajectory> path;
    std::optional<RunLines> lines;  ///< of its points; nullopt: lines_of() finds them

    /// The positions of a role on the part. Throws InputError: the log lacks them. O(1), or O(points) with kinematics.
    [[nodiscard]] Trajectory positions(Role role) const;
};

/// A recorded run. Its log's diagnostics get those of its pose, and `path.rotary` if a rotary axis moves and there are no
/// kinematics. Throws InputError: the log has no records. O(1), or O(points) with rotary axes.
[[nodiscard]] PlacedRun placed_run(std::string name, Log log, const PlacingRules& rules);

/// The run of a part, which is placed already and has its lines. It shares the log's columns.
[[nodiscard]] PlacedRun placed_run(const Part& part);

/// Simulates a program, which has its motions as programmed: on five axes if it and the machine have them. The pose counts on
/// five axes only. Throws what simulate_to_log() throws (pipeline/simulated_log.h); InputError: it does not move. O(points).
[[nodiscard]] PlacedRun simulate_run(std::string name, Program program, const Machine& machine, const Vec3& start,
                                     const PlacingRules& rules);

/// `path`: the compared positions of the run. Without a program all points cut, unless the channel `line` marks them as idle.
/// Throws InputError: the log does not belong to the program of `rules` (unless accept_foreign); what reading it throws.
/// O(points + motions), parallel.
[[nodiscard]] RunLines lines_of(const PlacedRun& run, const Trajectory& path, const PlacingRules& rules,
                                Diagnostics& diagnostics);

/// state_tool_axes() by the program of the lines, if there is one (pipeline/state_tool_axes.h). `diagnostics`: gets
/// `path.tool-axis`; nullptr: nothing is added.
void state_tool_axes(Trajectory& path, const PlacedRun& run, const RunLines& lines, Diagnostics* diagnostics);

}  // namespace clsurf
