#pragma once
// What `profile` makes of its points: the path of the tool along a scan, or of a finished pass that deviations correct.

#include <optional>

#include "cli/profile_options.h"
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
