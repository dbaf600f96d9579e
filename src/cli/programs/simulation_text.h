#pragma once
// What `simulate` says of a run, for people.

#include <string>

#include "machine/kinematics.h"
#include "simulation/run/five_axis_simulator.h"
#include "simulation/run/simulator.h"

namespace clsurf::cli {

/// Points, duration, the greatest speed, acceleration and jerk, and what limited the points.
[[nodiscard]] std::string summary_text(const SimulationSummary& s);

/// The rows of rotary axes, and how far the tool axis leaves its great circles.
[[nodiscard]] std::string rotary_text(const FiveAxisSummary& s, const Kinematics& k);

}  // namespace clsurf::cli
