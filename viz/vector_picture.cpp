#include "viz/vector_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "viz/image.h"
#include "viz/image_library.h"

namespace clsurf::viz {
namespace {

constexpr double baseline = 0.35;  ///< distance of the baseline below the middle of a line, in text sizes

/// RFC 4648.
std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

/// Characters that XML does not allow are left out.
std::string xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20)
            out += c;
    }
    return out;
}

std::string png_of(const Drawing::Ground& ground) {
    Image image;
    image.width = ground.width;
    image.height = ground.height;
    image.rgb = ground.rgb;
    return encode_image(image, "", "png");
}

std::string hex(const Rgb& rgb) { return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]); }

std::string_view anchor_of(Align align) {
    return align == Align::left ? "start" : align == Align::right ? "end" : "middle";
}

}  // namespace

std::string svg_text(const Drawing& drawing, const std::string& title) {
    const auto down = [&](double y) { return drawing.height - y; };
    std::string svg = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"Arial, 'Liberation Sans', Helvetica, 'DejaVu Sans', sans-serif\">\n<title>{2}</title>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"{3}\"/>\n",
        drawing.width, drawing.height, xml(title), hex(drawing.background));
    for (const Drawing::Ground& ground : drawing.grounds) {
        const Rect& r = ground.place;
        svg += fmt::format(
            "<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" xlink:href=\"data:image/png;base64,{}\"/>\n",
            r.x, down(r.y + r.height), r.width, r.height, base64(png_of(ground)));
    }
    for (const FlatQuad& quad : drawing.quads) {
        // The width of a quad may be negative.
        const double x = std::min(quad.rect.x, quad.rect.x + quad.rect.width);
        const double top = std::max(quad.rect.y, quad.rect.y + quad.rect.height);
        svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                           down(top), std::abs(quad.rect.width), std::abs(quad.rect.height), hex(quad.rgb));
    }
    svg += "<g fill=\"none\" stroke-linejoin=\"round\">\n";
    std::map<std::array<double, 4>, int> clips;  // each rectangle once
    for (const FlatLine& line : drawing.lines) {
        if (line.points.size() < 2) continue;
        std::string clip;
        if (line.clip) {
            const Rect& r = *line.clip;
            const auto [found, is_new] =
                clips.try_emplace({r.x, r.y, r.width, r.height}, static_cast<int>(clips.size()) + 1);
            if (is_new)
                svg += fmt::format(
                    "<clipPath id=\"clip{}\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/></clipPath>\n",
                    found->second, r.x, down(r.y + r.height), r.width, r.height);
            clip = fmt::format(" clip-path=\"url(#clip{})\"", found->second);
        }
        if (line.opposite.empty())
            svg += fmt::format("<polyline{} stroke=\"{}\" stroke-width=\"{:.2f}\" points=\"", clip, hex(line.rgb),
                               line.width);
        else
            svg += fmt::format("<polygon{} fill=\"{}\" points=\"", clip, hex(line.rgb));
        std::string_view separator;
        for (const Vec2& point : outline_of(line)) {
            svg += fmt::format("{}{:.2f},{:.2f}", separator, point.x(), down(point.y()));
            separator = " ";
        }
        svg += "\"/>\n";
    }
    svg += "</g>\n";
    for (std::size_t i = 0; i < drawing.texts.size(); ++i) {
        const FlatText& text = drawing.texts[i];
        // Texts may have consecutive spaces, which count for their width. Chromium ignores the attribute on <svg>.
        svg += fmt::format(
            "<text xml:space=\"preserve\" x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\"{} text-anchor=\"{}\" fill=\"{}\" textLength=\"{:.2f}\" "
            "lengthAdjust=\"spacingAndGlyphs\">{}</text>\n",
            text.x, down(text.y) + baseline * text.size, text.size, text.bold ? " font-weight=\"bold\"" : "",
            anchor_of(text.align), hex(text.rgb), drawing.text_widths[i], xml(text.text));
    }
    return svg + "</svg>\n";
}

std::string pdf_bytes(const Drawing& drawing, const std::string& title) {
    std::string bytes;
    const auto sink = [](void* context, const void* data, std::size_t size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), size);
    };
    if (!image_library().pdf(drawing, title.c_str(), &bytes, sink))
        throw SystemError("the PDF cannot be written: out of memory");
    return bytes;
}

}  // namespace clsurf::viz
