#pragma once
// LogVerdict: one line on whether a log can be used as it is.

#include <string>

#include "core/diagnostic.h"
#include "log/log.h"
#include "mapping/program_match.h"

namespace clsurf {

struct LogVerdict {
    bool ok = false;   ///< there is no warning and no error
    std::string text;  ///< "OK: a run of part.nc, all of it, a record every 1 ms, no gaps"
};

/// The verdict from the diagnostics of check_health() and, if the log was compared with a program (`map.distance`), of
/// match_log().
/// `program`: its name; empty: none was given.
[[nodiscard]] LogVerdict log_verdict(const Log& log, const Diagnostics& diagnostics, const std::string& program,
                                     ProgramIdentity identity);

}  // namespace clsurf
