#include "scan/scan_cut.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf {

std::vector<ScanPoint> placed_scan(std::span<const Vec3> places, const SensorMount& mount) {
    std::vector<ScanPoint> points;
    points.reserve(places.size());
    for (const Vec3& place : places)
        points.push_back({place.x() + mount.ahead, mount.reference ? *mount.reference - place.z() : place.z()});
    std::stable_sort(points.begin(), points.end(), [](const ScanPoint& a, const ScanPoint& b) { return a.x < b.x; });
    return points;
}

ScanCut scan_cut(const std::string& name, std::span<const ScanPoint> points, const ScanCutRules& rules) {
    CleanScan scan = clean_scan(points, rules.outliers);
    const std::size_t fewest = std::max<std::size_t>(2, static_cast<std::size_t>(rules.fit.degree) + 1);
    if (scan.x.size() < fewest)
        throw InputError(Place::of_file(name), fmt::format("has {} points of different x: degree {} needs {}",
                                                           scan.x.size(), rules.fit.degree, fewest));
    WindowedFit fit = fit_windows(scan.x, scan.z, rules.fit);
    CutPath path(fit, rules.radius, rules.tolerance);
    if (const std::optional<Gouge> gouge = path.gouge())
        throw InputError(
            Place::of_file(name),
            fmt::format("a ball of radius {:g} mm cuts {:.4f} mm below the fit at X {:.3f} mm; the tightest "
                        "concave radius of the fit is {:.3g} mm",
                        rules.radius, gouge->depth, gouge->x, gouge->least_radius),
            "a smaller ball, or a longer --window, which gives a smoother fit");
    ScanCut cut{std::move(scan), std::move(fit), {}, 0, 0, 0, std::move(path)};
    double squares = 0;
    for (std::size_t i = 0; i < cut.scan.x.size(); ++i) {
        const double residual = cut.scan.z[i] - cut.fit.at(cut.scan.x[i]);
        cut.residuals.push_back(residual);
        squares += residual * residual;
        if (std::abs(residual) > cut.worst) {
            cut.worst = std::abs(residual);
            cut.worst_x = cut.scan.x[i];
        }
    }
    cut.rms = std::sqrt(squares / static_cast<double>(cut.scan.x.size()));
    return cut;
}

}  // namespace clsurf
