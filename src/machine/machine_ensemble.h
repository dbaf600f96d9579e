#pragma once
// Machines drawn from what is known of one machine.

#include <vector>

#include "machine/machine.h"

namespace clsurf {

/// How far the limits of a machine file without `[[uncertainty]]` are assumed to be wrong, one standard deviation.
inline constexpr double assumed_acceleration_error = 0.05, assumed_jerk_error = 0.1;

/// Machines that the knowledge about `machine` allows, the same ones at every call. Values with a standard error are
/// drawn from log-normal distributions, values with a lower bound between it and the value of the file, and
/// alternatives are spread over the machines. A machine without uncertainties has limits of acceleration and jerk that are drawn
/// with the assumed errors. The greatest speed error of `machine.fidelity` is added to the errors of accelerations.
[[nodiscard]] std::vector<Machine> machines_drawn_from(const Machine& machine, int count);

}  // namespace clsurf
