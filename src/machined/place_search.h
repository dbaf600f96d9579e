#pragma once
// PlaceSearch: the points of a log nearest to a place: by contact points if the tool is known, else by tips.

#include <vector>

#include "core/cutter_place.h"
#include "core/point.h"
#include "machined/contact_points.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct WantedPlace {
    Vec3 at = Vec3::Zero();   ///< [mm] in the workpiece
    bool from_above = false;  ///< z is not given; the topmost place at x, y is meant
    std::size_t pieces = 1;   ///< number of pieces of the path whose nearest point is requested
    bool of_tip = false;      ///< the place is one of the tool tip, whether the tool is known or not
};

struct FoundPlace {
    PointIndex point = 0;
    double distance = 0;  ///< [mm] from the wanted place; in the plane if that has no z
    CutterPlace place;
};

/// The nearest point of each of the nearest pieces, nearest first.
///
/// With `contacts`: among the pieces that cut. If the place is between two contact points, the nearer one is given. If several
/// pieces are near a place on the part, the one whose cutter touches it comes first, because fitted normals do not separate
/// passes whose contacts nearly meet, in hollows and at creases. Without contacts: among all pieces, by tips.
///
/// From above, with an upright tool: the place is at the height that the cutters leave there; nothing is found if none reaches
/// it. From above otherwise: among cut pieces within half a step-over, only the topmost level, which ends where the next point
/// below is two step-overs deeper.
///
/// `step_over` [mm], 0: not known. O(points) for the tips, parallel; contact points are computed for pieces that may be among
/// the nearest.
[[nodiscard]] std::vector<FoundPlace> find_places(const Trajectory& path, const Passes& pieces,
                                                  const ContactPoints* contacts, double step_over,
                                                  const WantedPlace& wanted);

}  // namespace clsurf
