#pragma once
// Text for a terminal: its width in columns, and line breaking. UTF-8; every code point
// counts as one column.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clsurf::cli {

/// The columns of a text without line ends.
[[nodiscard]] std::size_t columns_of(std::string_view text);

/// Words filled into lines of at most `width` columns; a longer word is in a line of its own.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// ".png, .jpg or .jpeg"
[[nodiscard]] std::string join_words(const std::vector<std::string_view>& words, std::string_view conjunction);

/// A description split into paragraphs at empty lines: filled text, or literal lines (which begin with a
/// space in the source, as examples do).
struct Paragraph {
    bool literal = false;
    std::string text;  ///< one line if filled; lines with their ends if literal
};
[[nodiscard]] std::vector<Paragraph> paragraphs_of(std::string_view description);

}  // namespace clsurf::cli
