#pragma once
// The values of a machine that determine planned speeds, by their keys in the machine file.

#include <optional>
#include <string_view>

#include "machine/machine.h"

namespace clsurf {

/// A value that the speeds of a simulation depend on, in the unit of the machine file. `of`: an axis, "path" or "controller".
/// nullopt: the machine has no such value, or speeds do not depend on it.
[[nodiscard]] std::optional<double> planning_value(const Machine& machine, std::string_view key, std::string_view of);

/// Sets it; no effect if the machine has no such value.
void set_planning_value(Machine& machine, std::string_view key, std::string_view of, double value);

/// Whether the speeds of a simulation depend on this value, so that it may be uncertain.
[[nodiscard]] bool is_planning_value(std::string_view key, std::string_view of);

}  // namespace clsurf
