#pragma once
// ZoneMarker: where on a pass points lie, for what may be compared with what.

#include <vector>

#include "predictor/samples_in_work.h"
#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class ZoneMarker {
public:
    /// `end_zone` [mm] at the ends of pieces is outside; `period` [s]. Passes and pieces rise. All must outlive it.
    ZoneMarker(const Passes& passes, const std::vector<PointRange>& pieces, const ArcLength& arc_length,
               double end_zone, double period, SamplesInWork samples);

    /// Sets the zones of these points, from the speeds of their pieces' ends.
    void mark(const PointRange& points) const;

private:
    /// The zones at one end of a piece, walked from `end` inwards in `direction`, of those among `points`.
    void mark_end(PointIndex end, PointIndex count, int direction, const PointRange& points) const;

    const Passes& passes_;
    const std::vector<PointRange>& pieces_;
    const ArcLength& arc_length_;
    double end_zone_;
    double reach_;  ///< [mm] of an end
    PointIndex stride_;
    SamplesInWork samples_;
};

}  // namespace clsurf
