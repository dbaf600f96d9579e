#include "cli/programs/planned_cut.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "io/readers/program_file.h"
#include "scan/compensate.h"

namespace clsurf::cli {
namespace {

/// The plane of the cut: the Y of the scan, if the scan has a Y.
double plane_of(const MeasuredData& data) {
    if (data.kind == MeasuredKind::profile) return 0;
    const auto [least, most] = std::minmax_element(data.points.begin(), data.points.end(),
                                                   [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
    constexpr double tolerance = 1e-3;  // mm
    if (data.kind == MeasuredKind::areal || most->y() - least->y() > tolerance)
        throw InputError(Place::of_file(data.name), "is not a profile: its points do not have one y",
                         "--x and --z choose the columns of a profile");
    return least->y();
}

}  // namespace

PlannedCut planned_cut(const MeasuredData& data, const ProfileOptions& options) {
    const std::vector<ScanPoint> points = placed_scan(data.points, options.mount);
    const double plane = plane_of(data);
    if (options.pass.empty()) return {scan_cut(data.name, points, options.cut), plane, {}};
    const Program pass = io::read_program(options.pass, {});
    const PassTips tips = pass_tips(pass);
    const ScanCutRules& rules = options.cut;
    Compensation by =
        compensate(data.name, points, tips.places, {rules.fit, rules.outliers, rules.radius, rules.tolerance});
    // The profile is dense and has no outliers: a short window follows it.
    const ScanCutRules follow{0, FitRules(), rules.radius, rules.tolerance};
    ScanCut cut = scan_cut(options.pass, by.target, follow);
    if (cut.residuals.worst > rules.tolerance)
        throw InputError(
            Place::of_file(options.pass),
            fmt::format("the pass is up to {:.4f} mm from the corrected profile, at X {:.3f} mm: the tolerance is {:g}",
                        cut.residuals.worst, cut.residuals.worst_x, rules.tolerance),
            "a pass of lines has corners as high as its tolerance: a larger --tolerance");
    return {std::move(cut), tips.y, io::CorrectedPass{options.pass, std::move(by)}};
}

}  // namespace clsurf::cli
