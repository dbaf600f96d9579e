#pragma once
// PassesBetween: the programmed surface between its passes. A CL surface is known along the passes only; between two of
// them, passes are interpolated through both and those beyond on either side: by a cubic, or where the curvature changes
// from one value to another between the two (a ball that rolls round an edge), by two parabolas that meet there. Where the
// path across the passes has a corner or an edge at a pass or in the gap beside, those on the other side alone count; where
// two sides of a valley meet in a corner between the two passes, it goes as far as there. A tool that follows all of these
// leaves the programmed surface without its scallops, at creases and in fillets too.

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
    /// Odd, so that one of them lies over the cusp. Scallops become (seven + 1)² times lower.
    static constexpr int count = 7;

    /// `smoother`: of the positions inside one of `pieces`; nullptr: none. `near`: points that will be asked for, in
    /// order; these are smoothed once. `marks` are taken off the positions. All but `near` must outlive it.
    /// O(points in `near`).
    PassesBetween(const ClSurface& surface, const Signals& signals, const Differentiator* smoother,
                  const std::vector<PointRange>& pieces, std::span<const PointRange> near, const CuttingTool& tool,
                  double cell, const ProgrammedMarks& marks);

    /// The pass itself along points of a piece and, where it goes on, to the next one; and what lies between it and
    /// later passes beside it. O(points).
    void add(PointRange points, std::size_t piece, bool goes_on, const FrameAxes& axes, SweptPieces& swept) const;
    /// Computes what add() adds for such points once and for all: for many maps of one place. Not while others add.
    /// `points` begin behind those that are kept already. Memory: some 400 bytes a point.
    void keep(PointRange points, std::size_t piece, bool goes_on);

private:
    using Row = std::array<Vec3, count>;
    /// Smoothed positions of points one after the other, from the surface's origin.
    struct Run {
        PointIndex first = 0;
        std::vector<Eigen::Vector3f> at;
    };
    /// A straight motion [mm].
    struct Motion {
        Vec3 from, to;
    };
    /// What is kept of the points from one on.
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
    void motions_beside(PointRange points, Side side, Take&& take) const;

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
