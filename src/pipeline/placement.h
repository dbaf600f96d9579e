#pragma once
// Placement: how a program and a log come into one coordinate system.

#include <optional>

#include "core/diagnostic.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "program/frame_placement.h"

namespace clsurf {

/// The pose of the program's zero that a log's header gives; nullopt: it gives none.
[[nodiscard]] std::optional<Eigen::Isometry3d> pose_of(const Log& log);

/// The pose of the program's zero: what is given, else the log's own; a given default comes after the log's, with a
/// note `config.overruled` where they differ. nullopt: neither tells it.
[[nodiscard]] std::optional<Eigen::Isometry3d> zero_of(const FramePoses& given, const Log& log,
                                                       Diagnostics& diagnostics);

/// Brings a program, read with its motions as programmed, into the coordinates of the workpiece. The zero is that of
/// zero_of(); it goes before the program's own offsets, which count unless the path fits better without
/// (`map.coordinates`). Returns machine = pose · workpiece. Adds `program.work-offset` where the program cuts in
/// several systems whose offsets are not known. O(motions), and O(points) where the program sets offsets.
[[nodiscard]] Eigen::Isometry3d place_with(Program& program, const Log& log, const FramePoses& given,
                                           const Kinematics* kinematics, Diagnostics& diagnostics);

/// The same without a look at the path: the program's own offsets always count. O(motions).
Eigen::Isometry3d place_program(Program& program, const Log& log, FramePoses given, const Kinematics* kinematics,
                                Diagnostics& diagnostics);

/// Where the axes stood in the first record [mm], as make_tip_motions() takes it (toolpath/tip_motions.h). NaN: the log has no
/// positions.
[[nodiscard]] Vec3 start_of(const Log& log, const Kinematics& kinematics, const Eigen::Isometry3d& pose);

/// As place_with(), and with kinematics the motions are those of the tip: what the tips of the log are compared with.
[[nodiscard]] Eigen::Isometry3d place_tips_with(Program& program, const Log& log, const FramePoses& given,
                                                const Kinematics* kinematics, Diagnostics& diagnostics);

}  // namespace clsurf
