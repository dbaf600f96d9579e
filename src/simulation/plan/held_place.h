#pragma once
// HeldPlace: the limits that a place on a bent span gives to a SpeedProblem.

#include "simulation/path/axis_sample.h"
#include "simulation/plan/planned_motion.h"

namespace clsurf {

/// The speed along the programmed arc length that the bend at a place allows [mm/s], and the limiting factor.
struct BendSpeed {
    double speed = infinite_speed;
    LimitingFactor why = LimitingFactor::axis_acceleration;
};

struct HeldPlace {
    PathSample sample;  ///< its `at` is counted from the start of the part; its cap is the limit of the bend
    BendSpeed bend;
};

/// `arc_length`: from the start of the part [mm].
[[nodiscard]] HeldPlace held_place(const CellPart& part, double arc_length, const Machine& machine);

}  // namespace clsurf
