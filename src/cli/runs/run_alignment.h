#pragma once
// What two runs of a comparison do not have in common.

#include <string>

#include "cli/runs/runs.h"
#include "compare/run_difference.h"
#include "compare/run_report.h"

namespace clsurf::cli {

/// Throws InputError where nothing of B lies on A: another part, or another work offset.
void require_alignment(const RunDifferences& differences, const std::string& a, const std::string& b);

/// Warns where B has more than A: what A does not have is not compared.
void note_left_out(const RunReport& report, const LoadedRun& b, const std::string& a, Diagnostics& diagnostics);

}  // namespace clsurf::cli
