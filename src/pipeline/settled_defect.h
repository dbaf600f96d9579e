#pragma once
// Settled defects: defects of a running recording whose data are complete enough to judge them.
//
// A defect is judged by its surroundings: by an adjacent pass on either side and, to find which pass causes it, by three
// passes on one side. Next to another defect, three passes are needed on both sides. For a lag, these three are also needed,
// and eight passes on one side, to find whether it is systematic. The signals of the newest points are not known yet, because
// windows reach beyond them, and the end zone of a pass is not compared. Therefore a defect is settled when the tool has moved
// on by a settling distance after the last of these points.

#include <functional>
#include <optional>

#include "predictor/defect.h"
#include "predictor/signals.h"
#include "surface/cl_surface.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// [mm] the settling distance: the part at the end of a pass that is not compared, and the greatest gap within one defect.
/// `record`: length of a record at the usual speed [mm].
[[nodiscard]] double settling_distance(const ClSurface& surface, double record);

/// The surroundings of a defect.
struct DefectSurroundings {
    const ClSurface& surface;
    const Signals& signals;
    const ArcLength& arc_length;  ///< of the surface
    double settling = 0;          ///< [mm] settling_distance()
    /// Whether another defect is at a point.
    std::function<bool(PointIndex)> has_defect;
};

/// The last point that is needed to judge a defect, including the settling distance; nullopt: not recorded yet. O(runs).
[[nodiscard]] std::optional<PointIndex> last_point_needed(const Defect& defect, const DefectSurroundings& around);

}  // namespace clsurf
