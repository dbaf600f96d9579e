#pragma once
// A recorded run of the machine that `identify` examines.

#include "log/log.h"
#include "mapping/line_map.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct IdentifyRun {
    const Log* log = nullptr;
    const LineMap* lines = nullptr;    ///< nullptr: which motions are rapids is not known
    const Trajectory* tips = nullptr;  ///< of the tool in the workpiece; nullptr: what moves is the linear axes alone
};

}  // namespace clsurf
