#pragma once
// How far a simulation can be trusted: the fidelity of its machine file, from comparisons with recorded runs.

#include <optional>
#include <string>

#include "io/files/json_value.h"
#include "machine/fidelity.h"

namespace clsurf::io {

/// The object `fidelity`; null if it was never measured.
[[nodiscard]] Json fidelity_json(const std::optional<Fidelity>& fidelity);

/// Reads the object back; nullopt: null, or not such an object.
[[nodiscard]] std::optional<Fidelity> read_fidelity(const Json& json);

/// One line of text, with its line end.
[[nodiscard]] std::string fidelity_line(const std::optional<Fidelity>& fidelity);

}  // namespace clsurf::io
