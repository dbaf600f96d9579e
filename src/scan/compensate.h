#pragma once
// Compensation: a finished pass and the deviations that were measured along it → the profile that a corrected pass has to
// aim at, so that the part gets the form that the first pass was meant to leave.
//
// The deviation at x is the measured height less the wanted one: where material was left it is above 0, and the corrected
// pass goes as much lower there. It is taken off where the ball touched the part, not at its tip.

#include <span>
#include <string>
#include <vector>

#include "program/program.h"
#include "scan/clean_scan.h"
#include "scan/fit_residuals.h"
#include "scan/windowed_fit.h"

namespace clsurf {

/// A pass at feed in an XZ plane.
struct PassTips {
    std::vector<Vec2> places;  ///< [mm] x and z, in rising x
    double y = 0;              ///< [mm] of the plane
};
/// From the first cut of a program to its last. Throws InputError: no cut, a motion along Y, an arc, a pass that turns back
/// in X.
[[nodiscard]] PassTips pass_tips(const Program& program);

struct CompensationRules {
    FitRules fit;             ///< of the deviations
    double outliers = 5;      ///< of the deviations, multiples of the scatter
    double radius = 0;        ///< [mm] of the ball that made the pass; 0: its tip is on the profile
    double tolerance = 0.01;  ///< [mm] of the pass that is written
};

struct Compensation {
    std::vector<ScanPoint> target;  ///< the profile to aim at, in rising x
    CleanScan deviations;
    FitResiduals residuals;  ///< of the deviations that are kept
    double greatest = 0;     ///< [mm] correction, without its sign
    double greatest_x = 0;   ///< [mm]
};

/// `deviations`: x and deviation [mm], in rising x. `name`: of their file, for messages. Throws InputError: too few
/// deviations, a part of the pass without them, a pass that is tighter than the ball. O(points).
[[nodiscard]] Compensation compensate(const std::string& name, std::span<const ScanPoint> deviations,
                                      const std::vector<Vec2>& tips, const CompensationRules& rules);

}  // namespace clsurf
