#pragma once
// The keys of a TOML table as options. Used inside io only.

#include <string_view>
#include <vector>

#include "io/files/toml_table.h"
#include "io/readers/config_entry.h"

namespace clsurf::io {

/// The keys in the order of the file, without those in `except`. Throws InputError: a value that is not a text, number,
/// truth value or array of these.
[[nodiscard]] std::vector<ConfigEntry> config_entries(const TomlFile& file, const std::string& path,
                                                      const toml::table& table,
                                                      const std::vector<std::string_view>& except = {});

}  // namespace clsurf::io
