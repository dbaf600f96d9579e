#pragma once
// Oblique alignment: the displacement along the feed, from one pass to the next, of what the passes do.
//
// Passes that follow each other around a corner, or along an edge oblique to them, slow down one after the
// other: next to the place where one is slowest, the next one is not yet slow or no longer. A plane normal to
// the feed meets each of them at another moment of the same manoeuvre and shows differences where all do the
// same. Along the oblique direction they agree.

#include <array>
#include <optional>
#include <span>

#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

/// The place beside a point on another pass.
struct Beside {
    PathLocation at;
    int passes = 0;  ///< away: positive on the left, negative on the right
};

/// Motion and relief of the passes round a point, where the obliquity meets them.
struct ObliqueComparison {
    float speed = 0;               ///< [mm/s] median of the passes
    Eigen::Vector3f acceleration;  ///< median by component
    bool corner = false;           ///< the path turns there
    float relief = 0;              ///< [mm] the same, counted along the point's normal; NaN: not known
    /// Largest differences between the point and the passes next to it.
    float speed_step = 0, acceleration_step = 0, relief_step = 0;
};

/// Within 1.5 step-overs the path turns on the surface, about its normal, by more than 25°.
[[nodiscard]] bool turns_on_surface(const ClSurface& surface, const Signals& signals, PointIndex point);

/// The obliquity on which the passes adjacent to a point agree best among themselves, whatever the point itself
/// does. Nothing where they agree straight across the feed about as well, or are fewer than four, or three on one side alone. Where
/// the path turns on the surface by more than 25° within 1.5 step-overs: of each pass what is nearest to the point's
/// own motion within 1.5 step-overs per pass.
/// `places`: up to three on either side. O(points within some five step-overs of arc length).
[[nodiscard]] std::optional<ObliqueComparison> compare_obliquely(const ClSurface& surface, const Signals& signals,
                                                                 const PathLocation& here,
                                                                 std::span<const Beside> places);

}  // namespace clsurf
