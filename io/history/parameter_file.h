#pragma once
// The parameters of a history as a TOML file with one table each, as in docs/history.md.
//
//     [wear]
//     kind = "number"
//     unit = "mm"
//     range = [0, 0.2]

#include <string>

#include "history/parameter_rules.h"

namespace clsurf::io {

/// Throws InputError with file and line: unreadable, an unknown key or kind, an invalid range.
[[nodiscard]] ParameterRules read_parameter_rules(const std::string& path);

}  // namespace clsurf::io
