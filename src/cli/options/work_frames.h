#pragma once
// --work-offset.

#include <memory>
#include <optional>
#include <string>

#include "cli/subcommand.h"
#include "core/diagnostic.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "program/frame_placement.h"

namespace clsurf::cli {

/// --work-offset. `with_log`: the subcommand can read a log.
void declare_work_offset(po::options_description& options, bool with_log = true);
/// X,Y,Z or X,Y,Z,R of the program's zero, which is a default if it comes from the configuration; G55:X,Y,Z,R of a work
/// system that the program does not set.
[[nodiscard]] FramePoses read_work_offset(const po::variables_map& values);

/// The metadata of a log, a JSON object, with the pose of the program's zero added if it is known.
[[nodiscard]] std::string pose_metadata(const std::optional<Eigen::Isometry3d>& pose);

}  // namespace clsurf::cli
