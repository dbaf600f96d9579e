#pragma once
// PassesBetween: the programmed surface between its passes. A CL surface is known along the passes only. Between two passes,
// additional ones are interpolated through both and the next passes on either side: by a cubic, or, if the curvature changes
// from one value to another between the two (a ball that rolls around an edge), by two parabolas that meet there. If the path
// across the passes has a corner or an edge at a pass or in the adjacent gap, only the passes on the other side count. If two
// sides of a valley meet in a corner between the two passes, both are extended to that corner. A tool that follows all passes
// leaves the programmed surface without its scallops, also at creases and in fillets.

#include <array>
#include <span>
#include <vector>

#include "machined/map_frame.h"
#include "machined/swept_pieces.h"
#include "predictor/programmed_marks.h"
#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

class PassesBetween {
public:
    /// Odd, so that one of them is over the cusp. Scallops become (seven + 1)² times lower (docs/formed.md#definitions, Form).
    static constexpr int count = 7;

    /// `smoother`: for the positions inside one of `pieces`; nullptr: none. `near`: points that will be requested, in order;
    /// these are smoothed only once. `marks` are subtracted from the positions. All but `near` must outlive it. O(points in
    /// `near`).
    PassesBetween(const ClSurface& surface, const Signals& signals, const Differentiator* smoother,
                  const std::vector<PointRange>& pieces, std::span<const PointRange> near, const CuttingTool& tool,
                  double cell, const ProgrammedMarks& marks);

    /// Adds the pass itself along points of a piece, and to the next point if `goes_on`, and the passes between it and later
    /// adjacent ones. O(points).
    void add(PointRange points, std::size_t piece, bool goes_on, const FrameAxes& axes, SweptPieces& swept) const;
    /// Computes and stores what add() adds for such points, for several maps of one place. Not thread-safe with add(). `points`
    /// begin after those that are stored already. Memory: some 400 bytes per point.
    void keep(PointRange points, std::size_t piece, bool goes_on);

private:
    using Row = std::array<Vec3, count>;
    /// Smoothed positions of consecutive points, from the surface's origin.
    struct Run {
        PointIndex first = 0;
        std::vector<Eigen::Vector3f> at;
    };
    /// A straight motion [mm].
    struct Motion {
        Vec3 from, to;
    };
    /// Stored motions of the points from `first` on.
    struct Kept {
        PointIndex first = 0;
        std::vector<Motion> motions;
    };
    void smooth_into(PointRange points, std::vector<Eigen::Vector3f>& smoothed) const;
    [[nodiscard]] Vec3 smooth(PointIndex point) const;
    [[nodiscard]] Vec3 smooth(const PathLocation& at) const;
    [[nodiscard]] bool between(PointIndex point, Side side, Row& row) const;
    template <typename Take>
    void motions(PointRange points, std::size_t piece, bool goes_on, Take&& take) const;
    template <typename Take>
    void motions_of_adjacent(PointRange points, Side side, Take&& take) const;

    const ClSurface& surface_;
    const Signals& signals_;
    const Differentiator* smoother_;
    const std::vector<PointRange>& pieces_;
    const ProgrammedMarks& marks_;
    std::vector<Run> runs_;
    std::vector<Kept> kept_;
    double longest_ = 0, least_ = 0;  ///< [mm] pieces
};

}  // namespace clsurf
