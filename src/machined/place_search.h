#pragma once
// PlaceSearch: which points of a log are nearest to a place: contact points where the tool is known, else tips.

#include <vector>

#include "core/cutter_place.h"
#include "core/point.h"
#include "machined/contact_points.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct WantedPlace {
    Vec3 at = Vec3::Zero();   ///< [mm] in the workpiece
    bool from_above = false;  ///< z is not given: what lies topmost under x, y
    std::size_t pieces = 1;   ///< of how many pieces of the path the nearest point is wanted
    bool of_tip = false;      ///< a place of the tool tip, whether the tool is known or not
};

struct FoundPlace {
    PointIndex point = 0;
    double distance = 0;  ///< [mm] of that point's place; in the plane where the place has no z
    CutterPlace place;
};

/// The nearest point of each of the nearest pieces, nearest first. With `contacts`, of the pieces that cut:
/// the place may lie between two contact points, and the nearer one is given. Of the pieces about a place on
/// the part the one whose cutter touches it comes first: fitted normals do not tell passes apart whose contacts
/// all but meet, in hollows and at creases. Without contacts: of all pieces, by tips.
/// From above, with an upright tool: what the cutters leave of the height there is the place; nothing, where none
/// reaches. Else: of cut pieces, those as near as half a step-over, of them the topmost level, which ends where
/// the next point below lies two step-overs deeper. `step_over` [mm], 0: none is known.
/// O(points) for the tips, parallel; contact points are computed for pieces that may be among the nearest.
[[nodiscard]] std::vector<FoundPlace> find_places(const Trajectory& path, const Passes& pieces,
                                                  const ContactPoints* contacts, double step_over,
                                                  const WantedPlace& wanted);

}  // namespace clsurf
