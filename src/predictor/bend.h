#pragma once
// Bends: differences of speed that the layout of the passes explains.
//
// Where contour-parallel loops around two borders meet, their tips are next to passes that run straight on. A tip turns
// sharply, so the tool slows down for it, while the adjacent passes need not. The look-ahead of the controller explains such a
// difference, so it is expected. A bend explains a difference only if the tool takes it about as fast as the acceleration of
// the machine allows, brakes for it and speeds up right after it, and is no slower than an adjacent pass in a similar bend. The
// two corners of a link between loops are also bends, and so is a slight bend that the adjacent passes do not have.

#include <optional>

#include "predictor/mismatch.h"

namespace clsurf {

class Bends {
public:
    /// All must outlive it.
    Bends(const ClSurface& surface, const Signals& signals, const Thresholds& thresholds);

    /// Whether the slower side of the comparison (the point or the passes next to it) slows down for a bend of its own path.
    /// O(points within the braking distance).
    [[nodiscard]] bool explain(PointIndex point, const Comparison& comparison) const;

private:
    /// How the path turns around a point.
    struct Turn {
        float cosine = 1;  ///< cosine of the angle between the feeds one step-over before and after it, on the surface
        float acceleration = 0;  ///< [mm/s²] acceleration of the turn at the speed there
    };

    [[nodiscard]] bool slows_for_bend(PointIndex point) const;
    [[nodiscard]] bool is_bend(PointIndex point) const;
    /// Whether the path continues with a sideways step there, from a closed loop to the next one.
    [[nodiscard]] bool is_link(PointIndex point) const;
    /// The same within `reach` [mm] before and after the point.
    [[nodiscard]] bool leads_aside(PointIndex point, float reach) const;
    /// Whether a closed loop ends there and a link leads to the next one: the path reaches a place where it has already been,
    /// and leaves it again. This detects links in tight curves and links that slant by a few degrees, which the path alone does
    /// not show.
    [[nodiscard]] bool closes_loop(PointIndex point) const;
    /// Whether the point is a corner of a long link that slants by a few degrees. The path turns differently from the adjacent
    /// passes. Between its corners, the link crosses the place where the loop began, so that the distance to the adjacent pass
    /// grows from zero to one step-over.
    [[nodiscard]] bool is_corner_of_long_link(PointIndex point) const;
    /// Whether, between two points of the path, the distance to the adjacent pass falls below `below` step-overs and is about
    /// one step-over elsewhere.
    [[nodiscard]] bool distance_falls(PointIndex first, PointIndex last, float below) const;
    /// How much the turn of the path differs there from that of the adjacent passes, as difference of unit feeds. 0: it does
    /// not, or there is no adjacent pass.
    [[nodiscard]] float turn_difference(PointIndex point) const;
    /// Distance [mm] to the nearer neighbour, straight across; infinite: there is none.
    [[nodiscard]] float adjacent_distance(PointIndex point) const;
    [[nodiscard]] bool turns_alone(PointIndex bend, const Turn& turn) const;
    [[nodiscard]] bool is_faster_on_adjacent(PointIndex bend, const Turn& turn) const;
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
