#include "core/printable_text.h"

#include <cstdint>

#include <fmt/format.h>

namespace clsurf {

std::size_t printable_bytes(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(text[k]); };
    const std::uint8_t first = byte(at);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || at + size > text.size()) return 0;
    for (std::size_t k = 1; k < size; ++k) {
        if ((byte(at + k) & 0xc0) != 0x80) return 0;
    }
    const std::uint8_t second = byte(at + 1);
    const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool no_character = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
    const bool control = first == 0xc2 && second < 0xa0;
    return overlong || no_character || control ? 0 : size;
}

std::string printable(std::string_view text) {
    std::string shown;
    shown.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t size = printable_bytes(text, at);
        if (size == 0)
            shown += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(text[at]));
        else
            shown += text.substr(at, size);
        at += size == 0 ? 1 : size;
    }
    return shown;
}

}  // namespace clsurf
