#pragma once
// A recorded run of the machine that `identify` examines.

#include "log/log.h"
#include "mapping/line_map.h"

namespace clsurf {

struct IdentifyRun {
    const Log* log = nullptr;
    const LineMap* lines = nullptr;  ///< nullptr: which motions are rapids is not known
};

}  // namespace clsurf
