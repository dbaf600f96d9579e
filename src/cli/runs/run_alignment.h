#pragma once
// Checks how much two compared runs have in common.

#include <string>

#include "cli/runs/runs.h"
#include "compare/run_difference.h"
#include "compare/run_report.h"

namespace clsurf::cli {

/// Throws InputError if no part of B is on the path of A: another part, or another work offset.
void require_alignment(const RunDifferences& differences, const std::string& a, const std::string& b);

/// Warns if B has a path that A does not have: it is not compared.
void note_left_out(const RunReport& report, const LoadedRun& b, const std::string& a, Diagnostics& diagnostics);

}  // namespace clsurf::cli
