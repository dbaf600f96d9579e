#pragma once
// The output of `simulate` as text.

#include <string>

#include "machine/kinematics.h"
#include "simulation/run/five_axis_simulator.h"
#include "simulation/run/simulator.h"

namespace clsurf::cli {

/// Points, duration, the largest speed, acceleration and jerk, and the limiting factors of the points.
[[nodiscard]] std::string summary_text(const SimulationSummary& s);

/// The rows of rotary axes, and the deviation of the tool axis from its great circles.
[[nodiscard]] std::string rotary_text(const FiveAxisSummary& s, const Kinematics& k);

}  // namespace clsurf::cli
