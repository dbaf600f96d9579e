#pragma once
// Placement: transforms a program and a log into one coordinate system.

#include <optional>

#include "core/diagnostic.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "program/frame_placement.h"

namespace clsurf {

/// The pose of the program's zero in a log's header; nullopt: there is none.
[[nodiscard]] std::optional<Eigen::Isometry3d> pose_of(const Log& log);

/// The pose of the program's zero: the given one, else the log's own. A given default has lower priority than the log's
/// own; if they differ, adds a note `config.overruled`. nullopt: neither is known.
[[nodiscard]] std::optional<Eigen::Isometry3d> zero_of(const FramePoses& given, const Log& log,
                                                       Diagnostics& diagnostics);

/// Transforms a program, read with its motions as programmed, into the coordinates of the workpiece. The zero is that of
/// zero_of(). It has priority over the program's own offsets; these are used unless the path fits better without them
/// (`map.coordinates`). Returns machine = pose · workpiece. Adds `program.work-offset` if the program cuts in several
/// systems with unknown offsets. O(motions), and O(points) if the program sets offsets.
[[nodiscard]] Eigen::Isometry3d place_with(Program& program, const Log& log, const FramePoses& given,
                                           const Kinematics* kinematics, Diagnostics& diagnostics);

/// The same without checking the path: the program's own offsets are always used. O(motions).
Eigen::Isometry3d place_program(Program& program, const Log& log, FramePoses given, const Kinematics* kinematics,
                                Diagnostics& diagnostics);

/// Position of the axes in the first record [mm], as input of make_tip_motions() (toolpath/tip_motions.h). NaN: the log has
/// no positions.
[[nodiscard]] Vec3 start_of(const Log& log, const Kinematics& kinematics, const Eigen::Isometry3d& pose);

/// As place_with(); with kinematics the motions become those of the tip, for comparison with the tips of the log.
[[nodiscard]] Eigen::Isometry3d place_tips_with(Program& program, const Log& log, const FramePoses& given,
                                                const Kinematics* kinematics, Diagnostics& diagnostics);

}  // namespace clsurf
