#pragma once
// Text as HTML: programs, comments and file names are displayed and have no other effect.

#include <string>
#include <string_view>

namespace clsurf::io {

/// For element content and for attributes in double quotes. Control characters, marks that turn the direction of text,
/// and what is no UTF-8 (U+FFFD) become visible signs.
[[nodiscard]] std::string html(std::string_view text);

/// A table that scrolls sideways where it is wider than the page. `label`: its name for screen readers; `head`: its <th> cells;
/// `rows`: its <tr> elements.
[[nodiscard]] std::string wide_table(std::string_view label, std::string_view head, std::string_view rows);

/// JSON that may stand in a <script> of a type of its own: no `<` is left in it.
[[nodiscard]] std::string json_for_html(const std::string& json);

}  // namespace clsurf::io
