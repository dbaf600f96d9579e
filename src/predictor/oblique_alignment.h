#pragma once
// Oblique alignment: the displacement along the feed, from one pass to the next, of what the passes do.
//
// Passes along a corner, or along an edge oblique to them, slow down one after the other: at the slowest place of one pass, the
// next one is not slow yet, or no longer. A plane normal to the feed meets each of them at a different moment of the same
// manoeuvre, and shows differences although all do the same. Along the oblique direction they agree.

#include <array>
#include <optional>
#include <span>

#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

/// The adjacent place of a point on another pass.
struct AdjacentPlace {
    PathLocation at;
    int passes = 0;  ///< away: positive on the left, negative on the right
};

/// Motion and relief of the passes around a point, at their places along the obliquity.
struct ObliqueComparison {
    float speed = 0;               ///< [mm/s] median of the passes
    Eigen::Vector3f acceleration;  ///< median by component
    bool corner = false;           ///< the path turns there
    float relief = 0;              ///< [mm] the same, counted along the point's normal; NaN: not known
    /// Largest differences between the point and the passes next to it.
    float speed_step = 0, acceleration_step = 0, relief_step = 0;
};

/// Whether the path turns on the surface, about its normal, by more than 25° within 1.5 step-overs.
[[nodiscard]] bool turns_on_surface(const ClSurface& surface, const Signals& signals, PointIndex point);

/// The comparison along the obliquity for which the passes around a point agree best with each other, whatever the point itself
/// does. nullopt if they agree about as well straight across the feed, or are fewer than four, or three on one side only. If
/// the path turns on the surface by more than 25° within 1.5 step-overs, the place of each pass is the one whose motion is
/// nearest to that of the point, within 1.5 step-overs per pass. `places`: up to three on either side. O(points within some
/// five step-overs of arc length).
[[nodiscard]] std::optional<ObliqueComparison> compare_obliquely(const ClSurface& surface, const Signals& signals,
                                                                 const PathLocation& here,
                                                                 std::span<const AdjacentPlace> places);

}  // namespace clsurf
