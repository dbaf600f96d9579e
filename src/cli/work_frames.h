#pragma once
// --work-offset, and how a program and a log come into one coordinate system.

#include <memory>
#include <optional>

#include "cli/subcommand.h"
#include "core/diagnostic.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "program/frame_placement.h"

namespace clsurf::cli {

/// --work-offset
void declare_work_offset(po::options_description& options);
/// X,Y,Z or X,Y,Z,R of the program's zero; G55:X,Y,Z,R of a work system that the program does not set.
[[nodiscard]] FramePoses read_work_offset(const po::variables_map& values);

/// The pose of the program's zero that a log tells; nullopt: it does not.
[[nodiscard]] std::optional<Eigen::Isometry3d> pose_of(const Log& log);

/// Brings a program, read with its motions as programmed, into the coordinates of the workpiece. `given` goes before
/// what the log tells, that before the program's own offsets, which count unless the path fits better without
/// (`map.coordinates`). Returns machine = pose · workpiece. Adds
/// `program.work-offset` where the program cuts in several systems whose offsets are not known.
[[nodiscard]] Eigen::Isometry3d place_with(Program& program, const Log& log, FramePoses given,
                                           const Kinematics* kinematics, Diagnostics& diagnostics);

}  // namespace clsurf::cli
