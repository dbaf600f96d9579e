#pragma once
// Text of foreign files in messages: control sequences are shown instead of sent to the terminal.

#include <string>
#include <string_view>

namespace clsurf {

/// The text with control characters (C0, DEL, C1) and bytes that are no UTF-8 written as \xNN. O(bytes).
[[nodiscard]] std::string printable(std::string_view text);

/// How many bytes of `text` make the printable UTF-8 character at `at`; 0: a control character, or no UTF-8.
[[nodiscard]] std::size_t printable_bytes(std::string_view text, std::size_t at);

}  // namespace clsurf
