#pragma once
// Part: a program and a log of its run in one coordinate system, with the line of every point. All analysis begins
// with it.

#include <memory>
#include <optional>
#include <vector>

#include "core/diagnostic.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "machine/limit_table.h"
#include "machine/machine.h"
#include "machined/tool.h"
#include "mapping/line_map.h"
#include "mapping/program_match.h"
#include "program/frame_placement.h"
#include "program/program.h"
#include "surface/cl_surface.h"
#include "surface/passes.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct PartRules {
    std::optional<Role> role;                      ///< positions that are shown; nullopt: as shown_role() chooses
    FramePoses poses;                              ///< where the program's zero lies, before what log and program say
    std::shared_ptr<const Kinematics> kinematics;  ///< of a machine with rotary axes; nullptr: three axes
    bool use_line_channel = true;                  ///< false: lines are found by geometry alone
    bool accept_foreign = false;                   ///< a log of another program is a warning, not an error
    bool accept_unknown_tips = false;  ///< nor is one whose rotary axes turn, without kinematics that give the tips
    ProgramIdentity identity = ProgramIdentity::unknown;  ///< what hashes say (io/formats/program_identity.h)
    std::optional<CuttingTool> tool;
    std::vector<StatedLimit> limits;         ///< of the machine; empty: none are stated
    std::shared_ptr<const Machine> machine;  ///< that planned speeds are for; nullptr: the default one
    DerivativeMethod derivative = DerivativeMethod::savgol;
};

/// Owns all that it holds; the log's columns are shared between copies, and so are the lines.
struct Part {
    Program program;  ///< motions in the coordinates of the workpiece; without one: a single empty file
    Log log;
    Trajectory path;  ///< of the role that is shown
    std::shared_ptr<const LineMap> lines;
    DerivativeMethod derivative = DerivativeMethod::savgol;  ///< of fields
    std::optional<CuttingTool> tool;
    std::vector<StatedLimit> limits;         ///< of the machine
    std::shared_ptr<const Machine> machine;  ///< nullptr: not given
    Diagnostics diagnostics;                 ///< of program, log and lines together
};

/// Puts a program and a log together. `program` has its motions as programmed, each in its own work system
/// (io::ProgramOptions::coordinates empty). Throws InputError: the log is empty, lacks the channels of the role or of the
/// kinematics, or does not belong to the program (unless accept_foreign). O(points + motions), parallel.
[[nodiscard]] Part assemble(Program program, Log log, const PartRules& rules = {});

/// Puts another piece of the same recording into a part that assemble() made with these rules: program, placement, role,
/// tool and limits stay, and the diagnostics are those of the piece alone. A piece that does not belong to the program is no
/// error: its lines say so. Throws InputError: the piece is empty or lacks channels. O(points + motions), parallel.
void exchange_log(Part& part, Log log, const PartRules& rules);

/// A log alone: lines are those of its channel, or none, and all points cut but where that channel names no block.
/// Throws InputError: the log is empty or lacks channels.
[[nodiscard]] Part assemble(Log log, const PartRules& rules = {});

/// Of all points of a log that has neither a program nor a channel `line`; no program has so many lines.
inline constexpr LineNumber no_line = 0xffffffffU;

/// The line map of a log without its program, as assemble() makes it.
[[nodiscard]] LineMap lines_without_program(const Log& log, PointIndex count);

/// Throws InputError where the log does not belong to the program; with `accept` that is a warning `map.foreign`.
void refuse_foreign(const ProgramMatch& match, const Program& program, const Log& log, bool accept,
                    Diagnostics& diagnostics);

/// The CL surface of a part. O(points), parallel.
[[nodiscard]] ClSurface stitch(const Part& part);

/// The other positions that the log has, brought into the workpiece by the same way.
[[nodiscard]] std::vector<Trajectory> other_roles(const Part& part);

/// What derives the speeds of pieces of the part, as its derivative method asks; nullptr: savgol. O(points).
[[nodiscard]] std::shared_ptr<const MotionEstimate> estimate_motion(const Part& part, const Passes& pieces);

}  // namespace clsurf
