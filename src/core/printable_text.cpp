#include "core/printable_text.h"

#include <cstdint>

#include <fmt/format.h>

#include "core/utf8.h"

namespace clsurf {

std::size_t printable_bytes(std::string_view text, std::size_t at) {
    const CodePoint c = first_code_point(text.substr(at));
    const bool control = c.value < 0x20 || (c.value >= 0x7f && c.value < 0xa0);
    return control ? 0 : c.size;
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
