#pragma once
// Residuals of scanned points from the fit.

#include <vector>

#include "scan/clean_scan.h"
#include "scan/windowed_fit.h"

namespace clsurf {

struct FitResiduals {
    std::vector<double> values;  ///< [mm] by point: measured minus fitted
    double rms = 0;              ///< [mm]
    double worst = 0;            ///< [mm] greatest absolute residual
    double worst_x = 0;          ///< [mm] place of that residual
};

/// Domain: at least one point. O(points).
[[nodiscard]] FitResiduals fit_residuals(const CleanScan& scan, const WindowedFit& fit);

}  // namespace clsurf
