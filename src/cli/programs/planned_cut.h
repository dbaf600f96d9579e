#pragma once
// The tool path that `profile` plans: along a scan, or a finished pass corrected by measured deviations.

#include <optional>

#include "cli/programs/profile_options.h"
#include "io/reports/cut_report.h"
#include "measured/measured_data.h"
#include "scan/scan_cut.h"

namespace clsurf::cli {

/// What the tool is to follow, the plane of it, and the pass that it corrects where there is one.
struct PlannedCut {
    ScanCut cut;
    double plane = 0;
    std::optional<io::CorrectedPass> corrected;
};

/// Throws InputError: points that are no profile, a pass that cannot be corrected, and what scan_cut() throws.
[[nodiscard]] PlannedCut planned_cut(const MeasuredData& data, const ProfileOptions& options);

}  // namespace clsurf::cli
