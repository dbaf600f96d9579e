#pragma once
// ZoneMarker: assigns points to zones of their pass, which decide what is compared with what.

#include <vector>

#include "predictor/samples_in_work.h"
#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// The length at the ends of a pass that is not judged [mm]: on short passes a share of their length, but at least `shortest`.
struct EndZone {
    double usual = 0, shortest = 0;
};

class ZoneMarker {
public:
    /// `end_zone` at the ends of pieces is outside; `period` [s]. Passes and pieces are in ascending order. All must outlive
    /// it.
    ZoneMarker(const Passes& passes, const std::vector<PointRange>& pieces, const ArcLength& arc_length,
               const EndZone& end_zone, double period, SamplesInWork samples);

    /// Sets the zones of these points, from the speeds at the ends of their pieces.
    void mark(const PointRange& points) const;

private:
    /// Sets the zones at one end of a piece, from `end` inwards in `direction`, for those among `points`.
    void mark_end(PointIndex end, PointIndex count, double zone, int direction, const PointRange& points) const;

    /// The length outside at either end of a piece [mm].
    [[nodiscard]] double end_zone_of(const PointRange& piece) const;

    const Passes& passes_;
    const std::vector<PointRange>& pieces_;
    const ArcLength& arc_length_;
    EndZone end_zone_;
    double reach_;  ///< [mm] examined length from an end
    PointIndex stride_;
    SamplesInWork samples_;
};

}  // namespace clsurf
