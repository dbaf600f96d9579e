#pragma once
// Boundaries of constant-speed intervals that adjacent passes share. Each pass is divided by its own points, so the
// boundaries at one feature of the surface scatter from pass to pass. Without shared boundaries, speeds would change at
// another place on each pass.

#include <vector>

#include "surface/path_location.h"
#include "surface/programmed_surface.h"

namespace clsurf {

/// The boundaries of each cut pass: points of the surface where motions end, in ascending order, including both ends of the
/// pass.
using PassBoundaries = std::vector<std::vector<PointIndex>>;

/// The boundaries on the passes next to a place.
class AdjacentBoundaries {
public:
    /// `reach` [mm] along the path: boundaries of adjacent passes that are closer than this are at the same place across
    /// the feed. `programmed` must outlive the object. O(boundaries).
    AdjacentBoundaries(const ProgrammedSurface& programmed, const PassBoundaries& boundaries, double reach);

    struct Places {
        int passes = 0;               ///< number of existing passes, of two on each side
        std::vector<double> offsets;  ///< [mm] along the feed, for passes with a boundary at the same place
    };
    /// O(log boundaries)
    [[nodiscard]] Places around(PointIndex point) const;

    /// Places on the adjacent passes without a boundary, if the passes on both their sides have one there. `first`: the
    /// boundary is at the start of its pass.
    [[nodiscard]] std::vector<PointIndex> missing_on_adjacent(PointIndex boundary, bool first) const;

    /// Whether a boundary is within reach of a location on its own pass.
    [[nodiscard]] bool has_at(const PathLocation& at) const;

private:
    /// Offset of the nearest boundary along `feed` [mm]; NaN: none is within reach.
    [[nodiscard]] double offset_from(const PathLocation& at, const Eigen::Vector3f& feed) const;

    const ProgrammedSurface& programmed_;
    std::vector<PointIndex> boundaries_;
    double reach_;
};

/// Aligns boundaries with those of the adjacent passes. Each boundary moves to the median of its own place and those around
/// it. A pass gets a boundary if the passes on both sides have one there. The ends of passes do not move. `passes`: in the
/// order of the boundaries. O(boundaries · log boundaries).
[[nodiscard]] PassBoundaries share_boundaries(const ProgrammedSurface& programmed,
                                              const std::vector<ProgrammedPass>& passes,
                                              const PassBoundaries& boundaries, double reach);

}  // namespace clsurf
