#pragma once
// Escaping of text for HTML: programs, comments and file names are displayed and have no other effect.

#include <string>
#include <string_view>

namespace clsurf::io {

/// For element content and for attributes in double quotes. Control characters, marks that change the text direction,
/// and invalid UTF-8 (U+FFFD) become visible signs.
[[nodiscard]] std::string html(std::string_view text);

/// A table that scrolls sideways if it is wider than the page. `label`: its name for screen readers; `head`: its <th> cells;
/// `rows`: its <tr> elements.
[[nodiscard]] std::string wide_table(std::string_view label, std::string_view head, std::string_view rows);

/// JSON for a <script> of a data type: every `<` is escaped.
[[nodiscard]] std::string json_for_html(const std::string& json);

}  // namespace clsurf::io
