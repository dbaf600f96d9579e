#pragma once
// A recorded run of the machine that `identify` examines.

#include "log/log.h"
#include "mapping/line_map.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct IdentifyRun {
    const Log* log = nullptr;
    const LineMap* lines = nullptr;    ///< nullptr: unknown which motions are rapids
    const Trajectory* tips = nullptr;  ///< of the tool in the workpiece; nullptr: only linear axes move
};

}  // namespace clsurf
