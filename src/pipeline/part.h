#pragma once
// Part: a program and a log of its run in one coordinate system, with the line of every point. Every analysis begins with
// it.

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
    std::optional<Role> role;  ///< displayed positions; nullopt: shown_role() chooses
    FramePoses poses;          ///< pose of the program's zero; takes precedence over log and program
    std::shared_ptr<const Kinematics> kinematics;         ///< of a machine with rotary axes; nullptr: three axes
    bool use_line_channel = true;                         ///< false: lines are found by geometry only
    bool accept_foreign = false;                          ///< a log of another program is a warning, not an error
    bool accept_unknown_tips = false;                     ///< likewise for moving rotary axes without kinematics
    ProgramIdentity identity = ProgramIdentity::unknown;  ///< from hashes (io/formats/program_identity.h)
    std::optional<CuttingTool> tool;
    std::vector<StatedLimit> limits;         ///< of the machine; empty: there are none
    std::shared_ptr<const Machine> machine;  ///< for planned speeds; nullptr: the default machine
    DerivativeMethod derivative = DerivativeMethod::savgol;
};

/// Owns all its data; copies share the log's columns and the lines.
struct Part {
    Program program;  ///< motions in the coordinates of the workpiece; without one: a single empty file
    Log log;
    Trajectory path;  ///< of the displayed role
    std::shared_ptr<const LineMap> lines;
    DerivativeMethod derivative = DerivativeMethod::savgol;  ///< for fields
    std::optional<CuttingTool> tool;
    std::vector<StatedLimit> limits;         ///< of the machine
    std::shared_ptr<const Machine> machine;  ///< nullptr: not given
    Diagnostics diagnostics;                 ///< of program, log and lines
};

/// Combines a program and a log. `program` has its motions as programmed, each in its own work system
/// (io::ProgramOptions::coordinates empty). Throws InputError: the log is empty, lacks the channels of the role or of the
/// kinematics, or does not belong to the program (unless accept_foreign). O(points + motions), parallel.
[[nodiscard]] Part assemble(Program program, Log log, const PartRules& rules = {});

/// Puts another piece of the same recording into a part that assemble() made with these rules. Program, placement, role,
/// tool and limits remain; the diagnostics are those of the piece alone. A piece that does not belong to the program is no
/// error: its lines say so. Throws InputError: the piece is empty or lacks channels. O(points + motions), parallel.
void exchange_log(Part& part, Log log, const PartRules& rules);

/// A part of a log without a program. Lines are those of the log's channel, or none; all points cut except where that
/// channel has no block. Throws InputError: the log is empty or lacks channels.
[[nodiscard]] Part assemble(Log log, const PartRules& rules = {});

/// The line of all points if a log has neither a program nor a channel `line`; no program has so many lines.
inline constexpr LineNumber no_line = 0xffffffffU;

/// The line map of a log without its program, as assemble() makes it.
[[nodiscard]] LineMap lines_without_program(const Log& log, PointIndex count);

/// Throws InputError if the log does not belong to the program; with `accept` it adds a warning `map.foreign` instead.
void refuse_foreign(const ProgramMatch& match, const Program& program, const Log& log, bool accept,
                    Diagnostics& diagnostics);

/// The CL surface of a part. O(points), parallel.
[[nodiscard]] ClSurface stitch(const Part& part);

/// The other positions of the log, transformed into the workpiece like those of the part.
[[nodiscard]] std::vector<Trajectory> other_roles(const Part& part);

/// Estimates the motion on pieces of the part with its derivative method; nullptr: savgol. O(points).
[[nodiscard]] std::shared_ptr<const MotionEstimate> estimate_motion(const Part& part, const Passes& pieces);

}  // namespace clsurf
