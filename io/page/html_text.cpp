#include "io/page/html_text.h"

#include <cstdint>

#include <fmt/format.h>

namespace clsurf::io {
namespace {

struct CodePoint {
    std::uint32_t value = 0;
    std::size_t size = 0;  ///< bytes; 0: no UTF-8
};

/// The code point at the beginning of a text, by the table of well-formed sequences (Unicode 15, table 3-7).
CodePoint first_code_point(std::string_view text) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(text[k])) : 0U;
    };
    const auto follows = [&](std::size_t k) { return (byte(k) & 0xc0) == 0x80; };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    if (lead >= 0xc2 && lead < 0xe0 && follows(1)) return {(lead & 0x1f) << 6 | (byte(1) & 0x3f), 2};
    if (lead >= 0xe0 && lead < 0xf0 && follows(1) && follows(2)) {
        const std::uint32_t value = (lead & 0x0f) << 12 | (byte(1) & 0x3f) << 6 | (byte(2) & 0x3f);
        if (value >= 0x800 && (value < 0xd800 || value > 0xdfff)) return {value, 3};
    }
    if (lead >= 0xf0 && lead < 0xf5 && follows(1) && follows(2) && follows(3)) {
        const std::uint32_t value =
            (lead & 0x07) << 18 | (byte(1) & 0x3f) << 12 | (byte(2) & 0x3f) << 6 | (byte(3) & 0x3f);
        if (value >= 0x10000 && value <= 0x10ffff) return {value, 4};
    }
    return {};
}

/// Characters that are not seen but change how others are (Unicode's Bidi_Control, line separators).
bool turns_text(std::uint32_t c) {
    return c == 0x061c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) ||
           c == 0xfeff;
}

}  // namespace

std::string html(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const CodePoint c = first_code_point(text);
        const std::string_view bytes = text.substr(0, c.size > 0 ? c.size : 1);
        text.remove_prefix(bytes.size());
        if (c.size == 0)
            out += "\xef\xbf\xbd";
        else if (c.value == '&')
            out += "&amp;";
        else if (c.value == '<')
            out += "&lt;";
        else if (c.value == '>')
            out += "&gt;";
        else if (c.value == '"')
            out += "&quot;";
        else if (c.value == '\'')
            out += "&#39;";
        else if (c.value < 0x20 && c.value != '\t' && c.value != '\n')
            out += fmt::format("&#x{:x};", 0x2400 + c.value);  // the picture of it
        else if (c.value == 0x7f)
            out += "&#x2421;";
        else if (turns_text(c.value) || (c.value >= 0x80 && c.value < 0xa0))
            out += fmt::format("[U+{:04X}]", c.value);
        else
            out += bytes;
    }
    return out;
}

std::string wide_table(std::string_view label, std::string_view head, std::string_view rows) {
    return fmt::format(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n",
        label, head, rows);
}

std::string json_for_html(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

}  // namespace clsurf::io
