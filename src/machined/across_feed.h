#pragma once
// AcrossFeed: a place on the part and the direction across the feed there, along which profiles are measured.

#include <cstdint>
#include <vector>

#include "core/point.h"
#include "machined/as_machined_surface.h"
#include "machined/form.h"

namespace clsurf {

inline constexpr double steps_per_pass = 200;  ///< of a profile: a cusp's tip is then met to a hundredth of its height

/// Seen from above.
struct AcrossFeed {
    Vec2 at = Vec2::Zero();  ///< [mm] contact of the tool with the surface
    Vec2 direction = Vec2::UnitY();
    double step_over = 0;  ///< [mm] on a slope shorter than in the surface
    bool known = false;
};

/// Of a point; not known where its normal or its feed is not, or where it goes straight down.
[[nodiscard]] AcrossFeed across_feed(const AsMachinedSurface& as_machined, const Signals& signals, PointIndex point);

/// A row of `count` places: the first one [mm], the direction of the others from it, and how far they are apart.
struct ProfileRow {
    Vec2 from = Vec2::Zero(), along = Vec2::UnitX();
    double step = 0;  ///< [mm]
    std::int64_t count = 0;

    [[nodiscard]] MapFrame frame() const { return {from, along, step, count, 1}; }
};

/// A surface over a form, along a row.
struct RowDeviations {
    std::vector<double> deviation;  ///< [mm] NaN: nothing was cut, or no form there
    std::vector<double> along;      ///< [mm] arc length of the form from the first place; level where there is none
};

/// Over a form of the places of the row.
[[nodiscard]] RowDeviations deviations_along(const AsMachinedSurface& as_machined, const Form& form,
                                             const ProfileRow& row);
/// Over the form of `form_of`; `of` and `tolerance` as of Form.
[[nodiscard]] RowDeviations deviations_along(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                                             const ProfileRow& row, Form::Of of = Form::Of::program,
                                             double tolerance = 0);

}  // namespace clsurf
