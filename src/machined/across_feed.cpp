#include "machined/across_feed.h"

#include <algorithm>
#include <cmath>

namespace clsurf {

namespace {

/// Arc lengths [mm] at places `step` mm apart, seen from above, on a line with these slopes; if not finite, it counts as 0.
std::vector<double> arc_lengths(std::span<const float> slopes, double step) {
    std::vector<double> along(slopes.size());
    const auto steepness = [&](std::size_t k) {
        return std::isfinite(slopes[k]) ? std::hypot(1.0, static_cast<double>(slopes[k])) : 1.0;
    };
    for (std::size_t k = 1; k < slopes.size(); ++k)
        along[k] = along[k - 1] + 0.5 * step * (steepness(k - 1) + steepness(k));
    return along;
}

}  // namespace

AcrossFeed across_feed(const AsMachinedSurface& as_machined, const Signals& signals, PointIndex point) {
    AcrossFeed a;
    const Eigen::Vector3f feed = signals.feed(point);
    const Vec3 contact = as_machined.contact(point);
    const Vec2 flat = feed.head<2>().cast<double>();
    if (!contact.allFinite() || !feed.allFinite() || flat.norm() < 0.1) return a;
    a.at = contact.head<2>();
    a.direction = Vec2(-flat.y(), flat.x()).normalized();
    // The direction across the feed in the tangent plane of the surface.
    const Vec3 in_surface = signals.normal(point).cross(feed).cast<double>();
    a.step_over = as_machined.surface().step_over *
                  std::clamp(in_surface.head<2>().norm() / std::max(in_surface.norm(), 1e-9), 0.2, 1.0);
    a.known = true;
    return a;
}

RowDeviations deviations_along(const AsMachinedSurface& as_machined, const Form& form, const ProfileRow& row) {
    const MapFrame frame = row.frame();
    RowDeviations result;
    std::vector<float> slopes(static_cast<std::size_t>(row.count));
    as_machined.map(frame, [&](std::int64_t first_row, std::span<float> z) {
        form.subtract(frame, first_row, as_machined.level(), z, slopes);
        result.deviation.assign(z.begin(), z.end());
    });
    result.along = arc_lengths(slopes, row.step);
    return result;
}

RowDeviations deviations_along(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                               const ProfileRow& row, Form::Of of, double tolerance) {
    return deviations_along(as_machined, Form(form_of, row.frame().bounds(0, 0, row.count, 1), of, tolerance), row);
}

}  // namespace clsurf
