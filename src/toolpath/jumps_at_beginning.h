#pragma once
// Jumps of the acceleration among the first points of a piece.

#include "toolpath/acceleration_corners.h"

namespace clsurf {

/// A forward filter cannot detect jumps before it has learned the motion; a backward one can. Raises factors of points
/// from `first` on for the jumps that it detects. `measured` begins at point `from`, the first of a piece.
void raise_at_beginning(const AccelerationCorners& corners, const KalmanSmoother& smoother,
                        const Measurements& measured, PointIndex from, PointIndex first, Inflation& inflation);

}  // namespace clsurf
