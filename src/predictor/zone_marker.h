#pragma once
// ZoneMarker: where on a pass points lie, for what may be compared with what.

#include <vector>

#include "predictor/samples_in_work.h"
#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// What is not judged at the ends of a pass [mm]: on short passes a share of their length, but the shortest one at least.
struct EndZone {
    double usual = 0, shortest = 0;
};

class ZoneMarker {
public:
    /// `end_zone` at the ends of pieces is outside; `period` [s]. Passes and pieces rise. All must outlive it.
    ZoneMarker(const Passes& passes, const std::vector<PointRange>& pieces, const ArcLength& arc_length,
               const EndZone& end_zone, double period, SamplesInWork samples);

    /// Sets the zones of these points, from the speeds of their pieces' ends.
    void mark(const PointRange& points) const;

private:
    /// The zones at one end of a piece, walked from `end` inwards in `direction`, of those among `points`.
    void mark_end(PointIndex end, PointIndex count, double zone, int direction, const PointRange& points) const;

    /// What is outside at either end of a piece [mm].
    [[nodiscard]] double end_zone_of(const PointRange& piece) const;

    const Passes& passes_;
    const std::vector<PointRange>& pieces_;
    const ArcLength& arc_length_;
    EndZone end_zone_;
    double reach_;  ///< [mm] of an end
    PointIndex stride_;
    SamplesInWork samples_;
};

}  // namespace clsurf
