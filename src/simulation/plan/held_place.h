#pragma once
// HeldPlace: what a place of a part of a bent span says to a SpeedProblem.

#include "simulation/path/axis_sample.h"
#include "simulation/plan/planned_motion.h"

namespace clsurf {

/// The speed along the programmed arc length that the bend at a place allows [mm/s], and why.
struct BendSpeed {
    double speed = infinite_speed;
    LimitingFactor why = LimitingFactor::axis_acceleration;
};

struct HeldPlace {
    PathSample sample;  ///< its `at` from the begin of the part; its cap is that of the bend
    BendSpeed bend;
};

/// `arc_length` after the begin of the part [mm].
[[nodiscard]] HeldPlace held_place(const CellPart& part, double arc_length, const Machine& machine);

}  // namespace clsurf
