#pragma once
// The tool path that `profile` plans: along a scan, or a finished pass corrected by measured deviations.

#include <optional>

#include "cli/programs/profile_options.h"
#include "io/reports/cut_report.h"
#include "measured/measured_data.h"
#include "scan/scan_cut.h"

namespace clsurf::cli {

/// The profile that the tool follows, its plane, and the pass that it corrects, if any.
struct PlannedCut {
    ScanCut cut;
    double plane = 0;
    std::optional<io::CorrectedPass> corrected;
};

/// Throws InputError: points that are not a profile, a pass that cannot be corrected, and the errors of scan_cut().
[[nodiscard]] PlannedCut planned_cut(const MeasuredData& data, const ProfileOptions& options);

}  // namespace clsurf::cli
