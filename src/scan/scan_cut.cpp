#include "scan/scan_cut.h"

#include <algorithm>
#include <utility>

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

namespace {

/// Throws InputError if polynomials oscillate away from the points between them, as they do in gaps.
void check_range(const std::string& name, const CleanScan& scan, const CutPath& path) {
    const auto [low, high] = std::minmax_element(scan.z.begin(), scan.z.end());
    const double range = *high - *low;
    for (const Vec2& place : path.contacts()) {
        const double beyond = std::max(*low - place.y(), place.y() - *high);
        constexpr double tolerance = 1;  // mm: for planes, whose range is noise
        if (!(beyond <= range + tolerance))
            throw InputError(
                Place::of_file(name),
                fmt::format("the fit swings {:.3g} mm beyond all points, at X {:.6g} mm", beyond, place.x()),
                "points are missing there, or too close together: a lower --degree, or a longer --window");
    }
}

}  // namespace

ScanCut scan_cut(const std::string& name, std::span<const ScanPoint> points, const ScanCutRules& rules) {
    CleanScan scan = clean_scan(points, rules.outliers);
    const std::size_t fewest = std::max<std::size_t>(2, static_cast<std::size_t>(rules.fit.degree) + 1);
    if (scan.x.size() < fewest)
        throw InputError(Place::of_file(name), fmt::format("has {} points of different x: degree {} needs {}",
                                                           scan.x.size(), rules.fit.degree, fewest));
    WindowedFit fit = fit_windows(scan.x, scan.z, rules.fit);
    CutPath path(fit, rules.radius, rules.tolerance);
    check_range(name, scan, path);
    if (const std::optional<Gouge> gouge = path.gouge())
        throw InputError(
            Place::of_file(name),
            fmt::format("a ball of radius {:g} mm cuts {:.4f} mm below the fit at X {:.3f} mm; the tightest "
                        "concave radius of the fit is {:.3g} mm",
                        rules.radius, gouge->depth, gouge->x, gouge->least_radius),
            "a smaller ball, or a longer --window, which gives a smoother fit");
    FitResiduals residuals = fit_residuals(scan, fit);
    return {std::move(scan), std::move(fit), std::move(residuals), std::move(path)};
}

}  // namespace clsurf
