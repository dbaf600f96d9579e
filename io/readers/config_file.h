#pragma once
// .clsurf.toml: default options. Its keys are names of options; the caller judges their values.

#include <string>
#include <vector>

#include "io/readers/config_entry.h"

namespace clsurf::io {

/// The entries in the order of the file. Throws InputError: missing, malformed, a value that is no text, number, truth
/// value or array of those.
[[nodiscard]] std::vector<ConfigEntry> read_config(const std::string& path);

}  // namespace clsurf::io
