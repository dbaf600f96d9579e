#pragma once
// The common part of all SARIF 2.1.0 reports: locations in a program and the frame around the results.
// Used inside io only.

#include <string>

#include "core/point.h"
#include "io/files/json_value.h"

namespace clsurf::io {

/// A path as a URI reference: characters that RFC 3986 does not allow are escaped.
[[nodiscard]] std::string sarif_uri(const std::string& path);

/// Lines of a program, optionally with a message; first 0: the whole file.
[[nodiscard]] Json sarif_location(const std::string& uri, LineNumber first, LineNumber last,
                                  const std::string& message);

/// A log of one run with its rules and results.
/// `notifications`: messages about the run itself, with level and text; `successful`: the run was completed.
[[nodiscard]] std::string sarif_text(Json rules, Json results, Json notifications = Json::array(),
                                     bool successful = true);

}  // namespace clsurf::io
