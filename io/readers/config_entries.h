#pragma once
// The keys of a TOML table as options. Used inside io only.

#include <string_view>
#include <vector>

#include "io/files/toml_table.h"
#include "io/readers/config_entry.h"

namespace clsurf::io {

/// In the order of the file, but the keys in `except`. Throws InputError: a value that is no text, number, truth value or
/// array of those.
[[nodiscard]] std::vector<ConfigEntry> config_entries(const TomlFile& file, const std::string& path,
                                                      const toml::table& table,
                                                      const std::vector<std::string_view>& except = {});

}  // namespace clsurf::io
