#pragma once
// Boundaries of constant-speed intervals that adjacent passes share. Each pass is divided by its own points, so the
// boundaries at one feature of the surface scatter from pass to pass, and speeds would change at another place on each.

#include <vector>

#include "surface/path_location.h"
#include "surface/programmed_surface.h"

namespace clsurf {

/// Per cut pass its boundaries: points of the surface where motions end, ascending, both ends of the pass among them.
using PassBoundaries = std::vector<std::vector<PointIndex>>;

/// The boundaries of the passes next to a place.
class AdjacentBoundaries {
public:
    /// `reach` [mm] along the path: two boundaries of adjacent passes that are closer are at the same place across the
    /// feed. `programmed` must outlive it. O(boundaries).
    AdjacentBoundaries(const ProgrammedSurface& programmed, const PassBoundaries& boundaries, double reach);

    struct Places {
        int passes = 0;               ///< how many of two passes on each side exist
        std::vector<double> offsets;  ///< [mm] along the feed, of those that have a boundary at the same place
    };
    /// O(log boundaries)
    [[nodiscard]] Places around(PointIndex point) const;

    /// Places of the adjacent passes that have no boundary, while the passes on both their sides have one there. `first`: the
    /// boundary is where its pass begins.
    [[nodiscard]] std::vector<PointIndex> missing_beside(PointIndex boundary, bool first) const;

    /// Whether a boundary is within reach of a location on its own pass.
    [[nodiscard]] bool has_at(const PathLocation& at) const;

private:
    /// Of the nearest boundary along `feed` [mm]; NaN: none within reach.
    [[nodiscard]] double offset_from(const PathLocation& at, const Eigen::Vector3f& feed) const;

    const ProgrammedSurface& programmed_;
    std::vector<PointIndex> boundaries_;
    double reach_;
};

/// Brings boundaries into line with those of the adjacent passes: each moves to the median of the places that it and the
/// boundaries around it have; a pass gets a boundary where the passes on both sides have one. Ends of passes stay.
/// `passes`: in the order of the boundaries. O(boundaries · log boundaries).
[[nodiscard]] PassBoundaries share_boundaries(const ProgrammedSurface& programmed,
                                              const std::vector<ProgrammedPass>& passes,
                                              const PassBoundaries& boundaries, double reach);

}  // namespace clsurf
