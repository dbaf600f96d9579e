#pragma once
// How far a simulation can be trusted: what a machine file says of runs that were compared with it.

#include <optional>
#include <string>

#include "io/files/json_value.h"
#include "machine/fidelity.h"

namespace clsurf::io {

/// The object `fidelity`; null where it was never measured.
[[nodiscard]] Json fidelity_json(const std::optional<Fidelity>& fidelity);

/// The same read back; nullopt: null, or not such an object.
[[nodiscard]] std::optional<Fidelity> read_fidelity(const Json& json);

/// One line for people, with its end.
[[nodiscard]] std::string fidelity_line(const std::optional<Fidelity>& fidelity);

}  // namespace clsurf::io
