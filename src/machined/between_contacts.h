#pragma once
// Between contacts: the region of the plane between the contact points of adjacent passes. There the tool leaves the surface of
// the part; beyond the outermost contact points there is only the shape of its flank.

#include <functional>

#include "machined/as_machined_surface.h"

namespace clsurf {

/// Calls f(place) for places [mm] between the contact points of adjacent passes around a region, no farther apart than
/// `spacing`. In a valley that is tighter than the tool, contact points are far apart, and the region between them is included.
/// O(its area / spacing² + points near the region).
void for_each_between_contacts(const AsMachinedSurface& as_machined, const Box2& region, double spacing,
                               const std::function<void(const Vec2& place)>& f);

}  // namespace clsurf
