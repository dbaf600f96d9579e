#pragma once
// What a terminal can show: its width, and colours where the user has not turned them off.

#include <cstddef>
#include <string>
#include <string_view>

namespace clsurf::cli {

/// Columns of a help text: 80, or those of a narrower terminal.
[[nodiscard]] std::size_t help_columns();

/// Columns of a table: those of the terminal; 80 where standard output is none.
[[nodiscard]] std::size_t table_columns();

/// Breaks lines that are wider than the terminal at blanks. Returns the text as it is where standard output is no terminal.
[[nodiscard]] std::string fit_terminal(std::string_view text);

/// Colours may be written: a terminal that is not "dumb", and NO_COLOR is not set; CLICOLOR_FORCE asks for them
/// everywhere (no-color.org, bixense.com/clicolors).
[[nodiscard]] bool shows_colours(int descriptor);

/// Messages with "error:", "warning:", "note:" and "hint:" in colour.
[[nodiscard]] std::string coloured_message(std::string_view text);

/// Writes messages to standard error, in colour where it shows them.
void write_message(std::string_view text);

}  // namespace clsurf::cli
