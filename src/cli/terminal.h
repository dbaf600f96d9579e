#pragma once
// Properties of the terminal: its width, and whether colours are allowed.

#include <cstddef>
#include <string>
#include <string_view>

namespace clsurf::cli {

/// Columns of a help text: at most 80, fewer on a narrower terminal.
[[nodiscard]] std::size_t help_columns();

/// Columns of a table: those of the terminal; 80 if standard output is not a terminal.
[[nodiscard]] std::size_t table_columns();

/// Breaks lines that are wider than the terminal at blanks. Text for other outputs is not changed.
[[nodiscard]] std::string fit_terminal(std::string_view text);

/// Whether colours may be written: on a terminal that is not "dumb", unless NO_COLOR is set; CLICOLOR_FORCE allows them
/// everywhere (no-color.org, bixense.com/clicolors).
[[nodiscard]] bool shows_colours(int descriptor);

/// Messages with "error:", "warning:", "note:" and "hint:" in colour.
[[nodiscard]] std::string coloured_message(std::string_view text);

/// Writes messages to standard error, in colour if allowed.
void write_message(std::string_view text);

}  // namespace clsurf::cli
