#pragma once
// The tables [[uncertainty]] of a machine file (docs/formats/machine.md). Used inside io only.

#include <string>
#include <vector>

#include "io/files/toml_table.h"
#include "machine/uncertainty.h"

namespace clsurf::io {

/// Throws InputError: unknown key, wrong type, a value that cannot have an uncertainty, no or several kinds of uncertainty.
[[nodiscard]] std::vector<ParameterUncertainty> read_uncertainty(const TomlFile& file, const toml::array& rows);

/// One table each; empty: there are none.
[[nodiscard]] std::string uncertainty_text(const std::vector<ParameterUncertainty>& rows);

}  // namespace clsurf::io
