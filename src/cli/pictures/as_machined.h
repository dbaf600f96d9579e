#pragma once
// The formed surface of a part as a picture shows it.

#include "field/field.h"
#include "pipeline/as_machined_part.h"
#include "viz/relief.h"
#include "viz/view.h"

namespace clsurf::cli {

/// What a map of the formed surface is drawn from.
struct AsMachinedMap {
    viz::Relief relief;
    Field field;  ///< deviations over the relief's vertices
};

/// As fine as a picture's pixels, each vertex the mean of its cells. `box` empty: all that `camera` shows.
[[nodiscard]] AsMachinedMap make_as_machined_map(const AsMachinedPart& part, const Box3& box,
                                                 const viz::Camera& camera);

}  // namespace clsurf::cli
