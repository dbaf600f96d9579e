#pragma once
// Machine files of settings: what `simulate --tradeoff` and clsurf.tradeoff() write and plan with.

#include <string>

#include "machine/machine.h"
#include "tradeoff/plan_settings.h"
#include "tradeoff/settings_search.h"

namespace clsurf::io {

/// The machine file of the settings that a weight (0 … 1) chose, with a comment that says so.
[[nodiscard]] std::string chosen_settings_text(const Machine& machine, const PlanSettings& settings, double weight);

/// The machines that reading the files of settings gives: numbers have twelve digits there. `machine` must outlive it.
[[nodiscard]] MachineOfSettings machines_as_read(const Machine& machine);

}  // namespace clsurf::io
