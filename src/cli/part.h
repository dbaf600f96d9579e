#pragma once
// Part: a program and a log of it, read and put together: the first five of the seven calls that
// every subcommand on a log begins with (docs/design/map.md).

#include <memory>
#include <optional>
#include <string>

#include "cli/known_tool.h"
#include "cli/options.h"
#include "cli/stage_clock.h"
#include "field/field_set.h"
#include "log/log.h"
#include "path/line_map.h"
#include "path/trajectory.h"
#include "program/frame_placement.h"
#include "program/program.h"
#include "quality/tool.h"
#include "surface/cl_surface.h"

namespace clsurf::cli {

struct PartOptions {
    std::string program, log;
    io::ProgramOptions program_options;
    io::LogOptions log_options;
    Role role = Role::commanded;
    bool role_given = true;  ///< false: commanded where the log has it
    bool formed = false;     ///< --surface formed
    FramePoses poses;        ///< --work-offset
    std::string machine;     ///< machine file with the kinematics; empty: three axes
    bool use_line_channel = true;
    bool force = false;  ///< go on with a log that does not belong to the program
    ToolChoice tool;
    DerivativeMethod derivative = DerivativeMethod::savgol;
};

/// --dialect, --block-delete, --tools, --layout, --mapping, --period, --surface, --work-offset, --machine, --ignore-lines.
/// `can_form`: --surface may be `formed` too.
void declare_part(po::options_description& options, bool can_form = false);
/// --derivative, of what shows fields.
void declare_derivative(po::options_description& options);
[[nodiscard]] PartOptions read_part_options(const po::variables_map& values);
/// The same where a log may come alone, as the only argument: `program` is empty then.
[[nodiscard]] PartOptions read_part_or_log_options(const po::variables_map& values);

/// "commanded", "feedback" or "actual". Throws UsageError.
[[nodiscard]] Role parse_role(const std::string& text);

struct Part {
    Program program;
    Log log;
    Trajectory path;  ///< of the role that is shown
    std::unique_ptr<LineMap> lines;
    DerivativeMethod derivative = DerivativeMethod::savgol;  ///< of fields
    std::optional<CuttingTool> tool;                         ///< as --tool, the log or the tool table tells it
    Diagnostics diagnostics;                                 ///< of program, log and map together
};

/// What the points of a log belong to without its program: the lines of its channel, or none; all cut but where that
/// channel says that no block is active.
[[nodiscard]] std::unique_ptr<LineMap> lines_without_program(const Log& log, PointIndex count);

/// Reads and maps. Without a program the lines are those of the log's channel. Throws InputError (also where the log does not
/// belong to the program, unless forced), UsageError.
[[nodiscard]] Part load_part(const PartOptions& options, StageClock& clock);

/// The tool of a part, or a UsageError that says what needs it, with an example.
[[nodiscard]] CuttingTool required_tool(const Part& part, const std::string& what, const std::string& example);

/// What derives the speeds of pieces of the part, as --derivative asks for it; nullptr: savgol. O(points).
[[nodiscard]] std::shared_ptr<const MotionEstimate> estimate_motion(const Part& part, const Passes& pieces);

/// The surface of a part. O(points).
[[nodiscard]] ClSurface stitch(const Part& part);

}  // namespace clsurf::cli
