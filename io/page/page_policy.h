#pragma once
// What a page's Content-Security-Policy says of its own scripts and styles. Used inside io only.

#include <string>
#include <string_view>

namespace clsurf::io {

/// "'sha256-…'": what a policy names an inline script or style by.
[[nodiscard]] std::string source_hash(std::string_view text);

}  // namespace clsurf::io
