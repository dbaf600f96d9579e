#pragma once
// Settled defects: those of a run that goes on, of which all is known that they are judged by.
//
// A defect is judged by what lies beside it: by an adjacent pass on either side and, to tell which pass is at fault, by three
// passes on one side. Beside another fault three are needed on both sides, and so they are for a lag, with eight on one side,
// which tell whether it is systematic. The signals of the newest points are not known yet: windows reach beyond them, and the
// end zone of a pass is not compared. So a defect is settled when the tool has gone on for a settling distance behind the last of
// the points beside it.

#include <functional>
#include <optional>

#include "predictor/defect.h"
#include "predictor/signals.h"
#include "surface/cl_surface.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// [mm] of the settling distance: what is not compared at the end of a pass, and what may lie between places of one defect.
/// `record`: length of a record at the usual speed [mm].
[[nodiscard]] double settling_distance(const ClSurface& surface, double record);

/// What a defect lies in.
struct DefectSurroundings {
    const ClSurface& surface;
    const Signals& signals;
    const ArcLength& arc_length;  ///< of the surface
    double settling = 0;          ///< [mm] settling_distance()
    /// Whether something else is at fault at a point.
    std::function<bool(PointIndex)> at_fault;
};

/// The last point that a defect is judged by, the settling distance included; nullopt: it was not recorded yet. O(runs).
[[nodiscard]] std::optional<PointIndex> last_point_needed(const Defect& defect, const DefectSurroundings& around);

}  // namespace clsurf
