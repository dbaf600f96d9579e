#pragma once
// scan_cut(): from scanned points to a tool path (after Duan et al., Research on tool cutting trajectory based on curve
// fitting algorithm), with windows that join without jumps and points as dense as the chord error requires.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "scan/clean_scan.h"
#include "scan/cut_path.h"
#include "scan/fit_residuals.h"
#include "scan/windowed_fit.h"

namespace clsurf {

/// The mounting of a sensor that scans along X.
struct SensorMount {
    std::optional<double>
        reference;     ///< [mm] height from which distances are measured downwards; none: heights are given
    double ahead = 0;  ///< [mm] along X from the recorded place to the scanned place
};

/// Scanned points as x and z [mm], in ascending x. `places`: x, and z or the distance as third component.
[[nodiscard]] std::vector<ScanPoint> placed_scan(std::span<const Vec3> places, const SensorMount& mount);

struct ScanCutRules {
    double outliers = 5;  ///< multiples of the scatter; 0: none is rejected
    FitRules fit;
    double radius = 0;        ///< [mm] of a ball that produces the fit; 0: the tip follows it
    double tolerance = 0.01;  ///< [mm] of the lines or spans
};

struct ScanCut {
    CleanScan scan;
    WindowedFit fit;
    FitResiduals residuals;  ///< of the accepted points
    CutPath path;
};

/// `name`: of the scan, for messages. Throws InputError: too few points for the degree, a fit that oscillates far
/// beyond the points, a ball that would gouge it.
[[nodiscard]] ScanCut scan_cut(const std::string& name, std::span<const ScanPoint> points, const ScanCutRules& rules);

}  // namespace clsurf
