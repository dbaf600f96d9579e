#pragma once
// Words joined to a list for a sentence.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace clsurf {

/// "a", "a and b", "a, b and c"; "" if there are no words.
[[nodiscard]] inline std::string listed(std::span<const std::string> words, std::string_view conjunction = "and") {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 < words.size() ? std::string(", ") : ' ' + std::string(conjunction) + ' ';
        text += words[i];
    }
    return text;
}

}  // namespace clsurf
