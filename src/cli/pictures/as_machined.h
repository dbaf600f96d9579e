#pragma once
// The as-machined surface of a part for pictures.

#include "field/field.h"
#include "pipeline/as_machined_part.h"
#include "viz/height_map.h"
#include "viz/view.h"

namespace clsurf::cli {

/// A map of the as-machined surface.
struct AsMachinedMap {
    viz::HeightMap height_map;
    Field field;  ///< deviations at the vertices of the height map
};

/// A map in the resolution of the picture; each vertex is the mean of its cells. `box` empty: everything that `camera` shows.
[[nodiscard]] AsMachinedMap make_as_machined_map(const AsMachinedPart& part, const Box3& box,
                                                 const viz::Camera& camera);

}  // namespace clsurf::cli
