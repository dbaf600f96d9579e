#pragma once
// What a terminal can show: its width, and colours where the user has not turned them off.

#include <cstddef>
#include <string>
#include <string_view>

namespace clsurf::cli {

/// Columns of a help text: 80, or those of a narrower terminal.
[[nodiscard]] std::size_t help_columns();

/// Colours may be written: a terminal that is not "dumb", and NO_COLOR is not set; CLICOLOR_FORCE asks for them
/// everywhere (no-color.org, bixense.com/clicolors).
[[nodiscard]] bool shows_colours(int descriptor);

/// Messages with "error:", "warning:", "note:" and "hint:" in colour.
[[nodiscard]] std::string coloured_message(std::string_view text);

/// Writes messages to standard error, in colour where it shows them.
void write_message(std::string_view text);

}  // namespace clsurf::cli
