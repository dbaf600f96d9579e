#pragma once
// What all SARIF 2.1.0 reports share: locations in a program and the frame round the results.
// Used inside io only.

#include <string>

#include "core/point.h"
#include "io/files/json_value.h"

namespace clsurf::io {

/// A path as a URI reference: what RFC 3986 does not allow in one is escaped.
[[nodiscard]] std::string sarif_uri(const std::string& path);

/// Lines of a program, with a message where there is one; first 0: the whole file.
[[nodiscard]] Json sarif_location(const std::string& uri, LineNumber first, LineNumber last,
                                  const std::string& message);

/// A log of one run with its rules and results.
/// `notifications`: what the tool says of the run itself, a level and a text each; `successful`: it could be done.
[[nodiscard]] std::string sarif_text(Json rules, Json results, Json notifications = Json::array(),
                                     bool successful = true);

}  // namespace clsurf::io
