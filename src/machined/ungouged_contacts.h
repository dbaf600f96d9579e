#pragma once
// Ungouged contacts: contact points that the tool does not cut away on another section of its path.

#include <vector>

#include "machined/as_machined_surface.h"

namespace clsurf {

/// The contact points [mm] in a region, about every `spacing` mm along the passes, that remain on the part. If a form is more
/// concave than the tool, the tool cuts away on one pass what it touched on another, and the surface is lower there. Contact
/// points 20 µm or more inside the tool are excluded; chords and uneven passes cause smaller depths. Only one tip per square of
/// a grid is tested, which misses shallow cuts but gives no false ones. O(contact points + squares), parallel.
[[nodiscard]] std::vector<Vec3> ungouged_contacts(const AsMachinedSurface& as_machined, const Box2& region,
                                                  double spacing);

}  // namespace clsurf
