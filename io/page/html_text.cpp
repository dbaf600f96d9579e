#include "io/page/html_text.h"

#include <cstdint>

#include <fmt/format.h>

#include "core/utf8.h"

namespace clsurf::io {
namespace {

/// Invisible characters that change how others are displayed (Unicode's Bidi_Control, line separators).
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
            out += fmt::format("&#x{:x};", 0x2400 + c.value);  // its control picture
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
