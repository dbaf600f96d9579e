#pragma once
// Compensation: from a finished pass and the deviations measured along it to the target profile of a corrected pass, so
// that the part gets the intended form of the first pass.
//
// The deviation at x is the measured height minus the nominal one: positive if material remained, and then the corrected
// pass is lower there by the same amount. It is subtracted where the ball touched the part, not at its tip.

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
    std::vector<Vec2> places;  ///< [mm] x and z, in ascending x
    double y = 0;              ///< [mm] of the plane
};
/// The tips from the first cut of a program to its last. Throws InputError: no cut, a motion along Y, an arc, a pass that
/// turns back in X.
[[nodiscard]] PassTips pass_tips(const Program& program);

struct CompensationRules {
    FitRules fit;             ///< of the deviations
    double outliers = 5;      ///< of the deviations, multiples of the scatter
    double radius = 0;        ///< [mm] of the ball that made the pass; 0: its tip is on the profile
    double tolerance = 0.01;  ///< [mm] of the resulting pass
};

struct Compensation {
    std::vector<ScanPoint> target;  ///< the target profile, in ascending x
    CleanScan deviations;
    FitResiduals residuals;  ///< of the accepted deviations
    double greatest = 0;     ///< [mm] greatest absolute correction
    double greatest_x = 0;   ///< [mm]
};

/// `deviations`: x and deviation [mm], in ascending x. `name`: of their file, for messages. Throws InputError: too
/// few deviations, a part of the pass without them, a pass with a tighter curvature than the ball. O(points).
[[nodiscard]] Compensation compensate(const std::string& name, std::span<const ScanPoint> deviations,
                                      const std::vector<Vec2>& tips, const CompensationRules& rules);

}  // namespace clsurf
