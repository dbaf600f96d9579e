#include "scan/fit_residuals.h"

#include <cmath>

namespace clsurf {

FitResiduals fit_residuals(const CleanScan& scan, const WindowedFit& fit) {
    FitResiduals residuals;
    double squares = 0;
    for (std::size_t i = 0; i < scan.x.size(); ++i) {
        const double residual = scan.z[i] - fit.at(scan.x[i]);
        residuals.values.push_back(residual);
        squares += residual * residual;
        if (std::abs(residual) <= residuals.worst) continue;
        residuals.worst = std::abs(residual);
        residuals.worst_x = scan.x[i];
    }
    residuals.rms = std::sqrt(squares / static_cast<double>(scan.x.size()));
    return residuals;
}

}  // namespace clsurf
