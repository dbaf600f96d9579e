#pragma once
// Bends: differences of speed that the layout of the passes explains.
//
// Where contour-parallel loops round two borders meet, their tips lie side by side with passes that run straight on. A tip turns
// sharply, so the tool slows down for it, and the adjacent passes have no reason to. The planner's look-ahead explains such a
// difference: it is expected. It explains no more than that: the tool must take the bend about as fast as the machine's
// acceleration lets it, brake for it and speed up after it at once, and no slower than a pass beside it takes a bend like it.
// Both corners of a link that leads from a loop to the next one are bends, too, and so is a slight bend that the adjacent passes
// do not have.

#include <optional>

#include "predictor/mismatch.h"

namespace clsurf {

class Bends {
public:
    /// All must outlive it.
    Bends(const ClSurface& surface, const Signals& signals, const Thresholds& thresholds);

    /// The slower side of the comparison, the point or the passes next to it, slows down for a bend of its own path.
    /// O(points within the braking distance).
    [[nodiscard]] bool explain(PointIndex point, const Comparison& comparison) const;

private:
    /// How the path turns about a point.
    struct Turn {
        float cosine = 1;        ///< between the feed a step-over before it and a step-over after it, on the surface
        float acceleration = 0;  ///< [mm/s²] that it takes at the speed that is there
    };

    [[nodiscard]] bool slows_for_bend(PointIndex point) const;
    [[nodiscard]] bool is_bend(PointIndex point) const;
    /// There the path leads on and sideways, from a closed loop to the next one.
    [[nodiscard]] bool is_link(PointIndex point) const;
    /// The same within `reach` [mm] on either side.
    [[nodiscard]] bool leads_aside(PointIndex point, float reach) const;
    /// A closed loop ends there and a link leads to the next one: the path comes to where it has already run, and leaves again.
    /// This holds in tight curves and for links that slant by a few degrees, where the path alone does not show the link.
    [[nodiscard]] bool closes_loop(PointIndex point) const;
    /// Either corner of a long link that slants by a few degrees: the path turns otherwise than the passes beside it, and between
    /// its corners it leads over the place where the loop began, so that the distance to the pass beside it grows from nothing to
    /// a step-over.
    [[nodiscard]] bool is_corner_of_long_link(PointIndex point) const;
    /// Between two points of the path the distance to the pass beside it is below so many step-overs, and about one elsewhere.
    [[nodiscard]] bool distance_falls(PointIndex first, PointIndex last, float below) const;
    /// How much more or otherwise the path turns there than the passes beside it, as difference of unit feeds; 0: there is none.
    [[nodiscard]] float turn_of_its_own(PointIndex point) const;
    /// [mm] to the nearer one of the neighbours, straight across; infinite: there is none.
    [[nodiscard]] float distance_beside(PointIndex point) const;
    [[nodiscard]] bool turns_alone(PointIndex bend, const Turn& turn) const;
    [[nodiscard]] bool taken_faster_beside(PointIndex bend, const Turn& turn) const;
    [[nodiscard]] std::optional<PointIndex> slowest_ahead(PointIndex point, int direction) const;
    [[nodiscard]] Turn turn_at(PointIndex point) const;
    [[nodiscard]] PointIndex at_distance(PointIndex from, int direction, float distance) const;
    [[nodiscard]] PointIndex stride_at(PointIndex point) const;

    const ClSurface& surface_;
    const Signals& signals_;
    const Thresholds& thresholds_;
    float step_over_;
};

}  // namespace clsurf
