#pragma once
// .clsurf.toml: default options. Its keys are names of options; the caller checks their values.

#include <string>
#include <vector>

#include "io/readers/config_entry.h"

namespace clsurf::io {

/// The entries in the order of the file. Throws InputError: missing, malformed, a value that is not a text, number, truth
/// value or array of these.
[[nodiscard]] std::vector<ConfigEntry> read_config(const std::string& path);

}  // namespace clsurf::io
