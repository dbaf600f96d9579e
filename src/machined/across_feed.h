#pragma once
// AcrossFeed: a place on the part and the direction across the feed there, along which profiles are measured.

#include <cstdint>
#include <vector>

#include "core/point.h"
#include "machined/as_machined_surface.h"
#include "machined/form.h"

namespace clsurf {

// A cusp of height h = s²/(8 R) has the slope s/(2 R) at its tip, so that half a step away, at s/400, it is h/100 lower.
inline constexpr double steps_per_pass = 200;  ///< values of a profile; they meet a cusp's tip to 1 % of its height

/// A place and a direction, seen from above.
struct AcrossFeed {
    Vec2 at = Vec2::Zero();  ///< [mm] contact of the tool with the surface
    Vec2 direction = Vec2::UnitY();
    double step_over = 0;  ///< [mm] seen from above: on a slope, shorter than along the surface
    bool known = false;
};

/// The direction across the feed at a point. Not known if its normal or its feed is unknown, or if the feed is vertical.
[[nodiscard]] AcrossFeed across_feed(const AsMachinedSurface& as_machined, const Signals& signals, PointIndex point);

/// A row of `count` places: the first place [mm], the direction of the row, and the spacing.
struct ProfileRow {
    Vec2 from = Vec2::Zero(), along = Vec2::UnitX();
    double step = 0;  ///< [mm]
    std::int64_t count = 0;

    [[nodiscard]] MapFrame frame() const { return {from, along, step, count, 1}; }
};

/// Deviations of a surface from a form, along a row.
struct RowDeviations {
    std::vector<double> deviation;  ///< [mm] NaN: nothing was cut, or there is no form
    std::vector<double> along;  ///< [mm] arc length of the form from the first place; horizontal where there is none
};

/// Deviations from a form that covers the places of the row.
[[nodiscard]] RowDeviations deviations_along(const AsMachinedSurface& as_machined, const Form& form,
                                             const ProfileRow& row);
/// Deviations from the form of `form_of`; `of` and `tolerance` as for Form.
[[nodiscard]] RowDeviations deviations_along(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                                             const ProfileRow& row, Form::Of of = Form::Of::program,
                                             double tolerance = 0);

}  // namespace clsurf
