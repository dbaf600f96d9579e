#include "machined/across_feed.h"

#include <algorithm>

namespace clsurf {

AcrossFeed across_feed(const AsMachinedSurface& as_machined, const Signals& signals, PointIndex point) {
    AcrossFeed a;
    const Eigen::Vector3f feed = signals.feed(point);
    const Vec3 contact = as_machined.contact(point);
    const Vec2 flat = feed.head<2>().cast<double>();
    if (!contact.allFinite() || !feed.allFinite() || flat.norm() < 0.1) return a;
    a.at = contact.head<2>();
    a.direction = Vec2(-flat.y(), flat.x()).normalized();
    // The direction across that lies in the surface.
    const Vec3 in_surface = signals.normal(point).cross(feed).cast<double>();
    a.step_over = as_machined.surface().step_over *
                  std::clamp(in_surface.head<2>().norm() / std::max(in_surface.norm(), 1e-9), 0.2, 1.0);
    a.known = true;
    return a;
}

std::vector<double> deviations_along(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                                     const ProfileRow& row, Form::Of of, double tolerance) {
    const MapFrame frame{row.from, row.along, row.step, row.count, 1};
    const Form form(form_of, frame.bounds(0, 0, row.count, 1), of, tolerance);
    std::vector<double> deviations;
    map_deviation(as_machined, form, frame,
                  [&](std::int64_t, std::span<float> z) { deviations.assign(z.begin(), z.end()); });
    return deviations;
}

}  // namespace clsurf
