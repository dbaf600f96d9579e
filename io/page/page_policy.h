#pragma once
// The hashes of a page's own scripts and styles for its Content-Security-Policy. Used inside io only.

#include <string>
#include <string_view>

namespace clsurf::io {

/// "'sha256-…'": the source expression of an inline script or style.
[[nodiscard]] std::string source_hash(std::string_view text);

}  // namespace clsurf::io
