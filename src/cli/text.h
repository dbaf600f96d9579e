#pragma once
// Text for a terminal: its width in columns, and its lines broken to fit. UTF-8; every code point
// counts one column.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clsurf::cli {

/// Columns that a text without line ends takes.
[[nodiscard]] std::size_t columns_of(std::string_view text);

/// Words filled into lines of at most `width` columns; a longer word has a line of its own.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// ".png, .jpg or .jpeg"
[[nodiscard]] std::string join_words(const std::vector<std::string_view>& words, std::string_view conjunction);

/// A description as its paragraphs: filled text, or lines to be kept as they are (they begin with a
/// space in the source, as examples do). Empty lines part paragraphs.
struct Paragraph {
    bool literal = false;
    std::string text;  ///< one line when filled; lines with their ends when literal
};
[[nodiscard]] std::vector<Paragraph> paragraphs_of(std::string_view description);

}  // namespace clsurf::cli
