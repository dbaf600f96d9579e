#pragma once
// The table [fidelity] of a machine file (docs/formats/machine.md). Used inside io only.

#include <string>

#include "io/files/toml_table.h"
#include "machine/fidelity.h"

namespace clsurf::io {

/// Throws InputError: unknown key, wrong type, an impossible value.
[[nodiscard]] Fidelity read_fidelity(const TomlFile& file, const toml::table& table);

/// The table with all known values.
[[nodiscard]] std::string fidelity_text(const Fidelity& fidelity);

}  // namespace clsurf::io
