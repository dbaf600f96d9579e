#pragma once
// Counted nouns of messages.

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace clsurf {

/// "1 line", "2 lines": a number and a noun whose plural ends with s.
template <typename Number>
[[nodiscard]] std::string counted(Number count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}
/// "1 pass", "2 passes".
template <typename Number>
[[nodiscard]] std::string counted(Number count, std::string_view noun, std::string_view plural) {
    return fmt::format("{} {}", count, count == 1 ? noun : plural);
}

}  // namespace clsurf
