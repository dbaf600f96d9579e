#pragma once
// What remains between scanned points and the fit through them.

#include <vector>

#include "scan/clean_scan.h"
#include "scan/windowed_fit.h"

namespace clsurf {

struct FitResiduals {
    std::vector<double> values;  ///< [mm] by point: measured less fitted
    double rms = 0;              ///< [mm]
    double worst = 0;            ///< [mm] the greatest, without its sign
    double worst_x = 0;          ///< [mm] where that is
};

/// Domain: at least one point. O(points).
[[nodiscard]] FitResiduals fit_residuals(const CleanScan& scan, const WindowedFit& fit);

}  // namespace clsurf
