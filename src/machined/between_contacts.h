#pragma once
// Between contacts: the part of the plane that lies between the contact points of adjacent passes. There the tool leaves
// the part; beyond the outermost contact points stands its flank.

#include <functional>

#include "machined/as_machined_surface.h"

namespace clsurf {

/// f(place) for places [mm] between the contact points of adjacent passes, no farther apart than `spacing`, about a
/// region. In a valley that is tighter than the tool the contact points lie far apart, and what lies between them counts.
/// O(area of it / spacing² + points near the region).
void for_each_between_contacts(const AsMachinedSurface& as_machined, const Box2& region, double spacing,
                               const std::function<void(const Vec2& place)>& f);

}  // namespace clsurf
