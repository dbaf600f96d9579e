#pragma once
// Escaping of text for XML.

#include <string>
#include <string_view>

namespace clsurf::io {

/// For element content and for attributes in double quotes. Control characters, which XML does not allow, are not changed.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace clsurf::io
