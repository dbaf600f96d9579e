#pragma once
// The results of `identify` as text, as JSON, and as a machine file.

#include <string>

#include "identify/identification.h"

namespace clsurf::io {

/// Tables of the values and of the parameters that are not identified.
[[nodiscard]] std::string identification_text(const Identification& result);

[[nodiscard]] std::string identification_json(const Identification& result, const Diagnostics& diagnostics);

/// A machine file with every key. A comment after each value gives its standard error and the evidence, or says that
/// the value was not identified.
[[nodiscard]] std::string identified_machine_text(const Identification& result);

}  // namespace clsurf::io
