#pragma once
// Jumps of the acceleration among the first points of a piece.

#include "toolpath/acceleration_corners.h"

namespace clsurf {

/// A filter does not see jumps at its beginning, before it knows the motion: one that runs backward does. Raises factors of
/// points from `first` on for the jumps that it sees. `measured` begins at point `from`, the first of a piece.
void raise_at_beginning(const AccelerationCorners& corners, const KalmanSmoother& smoother,
                        const Measurements& measured, PointIndex from, PointIndex first, Inflation& inflation);

}  // namespace clsurf
