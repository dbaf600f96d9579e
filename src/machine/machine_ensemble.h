#pragma once
// Machines drawn from the uncertain values of one machine.

#include <vector>

#include "machine/machine.h"

namespace clsurf {

/// Assumed relative standard errors of the limits in a machine file without `[[uncertainty]]`.
inline constexpr double assumed_acceleration_error = 0.05, assumed_jerk_error = 0.1;

/// Machines drawn from the uncertainties of `machine`; every call gives the same ones. Values with a standard error are drawn
/// from log-normal distributions, values with a lower bound between it and the value of the file, and alternatives are
/// distributed over the machines. If a machine has no uncertainties, its limits of acceleration and jerk are drawn with the
/// assumed errors. The greatest speed error of `machine.fidelity` is added to the errors of accelerations.
[[nodiscard]] std::vector<Machine> machines_drawn_from(const Machine& machine, int count);

}  // namespace clsurf
