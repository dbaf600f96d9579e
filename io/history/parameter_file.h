#pragma once
// The parameters of a history as a TOML file: a table each, as docs/history.md says.
//
//     [wear]
//     kind = "number"
//     unit = "mm"
//     range = [0, 0.2]

#include <string>

#include "history/parameter_rules.h"

namespace clsurf::io {

/// Throws InputError with file and line: unreadable, an unknown key or kind, a range that is none.
[[nodiscard]] ParameterRules read_parameter_rules(const std::string& path);

}  // namespace clsurf::io
