#pragma once
// A baseline: the defects of an earlier run, from its report.

#include <string>
#include <vector>

#include "history/run_record.h"

namespace clsurf::io {

/// The defects in a report of `check`, JSON or SARIF, of all its logs. Throws InputError: unreadable, neither format, a
/// report of another subcommand.
[[nodiscard]] std::vector<RecordedDefect> read_baseline(const std::string& path);

}  // namespace clsurf::io
