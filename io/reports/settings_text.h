#pragma once
// Machine files of settings, for `simulate --tradeoff` and clsurf.tradeoff().

#include <string>

#include "machine/machine.h"
#include "tradeoff/plan_settings.h"
#include "tradeoff/settings_search.h"

namespace clsurf::io {

/// The machine file of the settings chosen by a weight (0 … 1), with a comment about the choice.
[[nodiscard]] std::string chosen_settings_text(const Machine& machine, const PlanSettings& settings, double weight);

/// The machines as read back from the files of settings, whose numbers have twelve digits. `machine` must outlive it.
[[nodiscard]] MachineOfSettings machines_as_read(const Machine& machine);

}  // namespace clsurf::io
