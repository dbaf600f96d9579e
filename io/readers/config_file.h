#pragma once
// .clsurf.toml: default options. Its keys are names of options; the caller judges their values.

#include <string>
#include <vector>

#include "core/place.h"

namespace clsurf::io {

struct ConfigEntry {
    std::string key;
    std::vector<std::string> values;  ///< as one would type them; an array has several
    bool is_flag = false;             ///< true or false: `on`, no values
    bool on = false;
    Place where;
};

/// The entries in the order of the file. Throws InputError: missing, malformed, a value that is no text, number, truth
/// value or array of those.
[[nodiscard]] std::vector<ConfigEntry> read_config(const std::string& path);

}  // namespace clsurf::io
