#pragma once
// Standing contacts: contact points that the tool does not cut away again on another part of its path.

#include <vector>

#include "machined/as_machined_surface.h"

namespace clsurf {

/// The contact points [mm] in a region, about every `spacing` mm along the passes, that the tool leaves
/// standing: where a form is hollower than the tool, it cuts away on one pass what it touched on
/// another, and the surface is lower there. Left out is what lies 20 µm or more inside the tool: chords and uneven
/// passes are shallower. Tips are looked at one per square of a grid, which misses shallow cuts and
/// finds none that is not there. O(contact points + squares), parallel.
[[nodiscard]] std::vector<Vec3> ungouged_contacts(const AsMachinedSurface& as_machined, const Box2& region,
                                                  double spacing);

}  // namespace clsurf
