#pragma once
// Whether a log is a run of a program.

#include <memory>

#include "core/diagnostic.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "mapping/program_match.h"
#include "program/frame_placement.h"
#include "program/program.h"

namespace clsurf {

/// Compares the points of a log with the lines of a program, read with its motions as programmed. The match is empty if one
/// of them has nothing to compare. Adds `map.distance`, and the diagnostics of placing and mapping. O(points + motions),
/// parallel.
[[nodiscard]] ProgramMatch match_log(Program program, const Log& log, const FramePoses& given,
                                     const std::shared_ptr<const Kinematics>& kinematics, ProgramIdentity identity,
                                     Diagnostics& diagnostics);

}  // namespace clsurf
