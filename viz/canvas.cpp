#include "viz/canvas.h"

#include <algorithm>
#include <cmath>

#include "viz/drawing.h"
#include "viz/vtk_library.h"

namespace clsurf::viz {

double text_width(const FlatText& text) { return vtk_library().text_width(text); }

Rect text_rect(const FlatText& text) {
    const double width = text_width(text);
    return {text.x - share_at_left(text.align) * width, text.y - 0.5 * text.size, width, text.size};
}

FlatLine halo_of(const FlatText& text, const Rgb& background) {
    const Rect rect = text_rect(text);
    return {{{rect.x, text.y}, {rect.x + rect.width, text.y}}, 1.1 * text.size, background, Level::halo};
}

FlatText fitted(FlatText text, double width) {
    if (text_width(text) <= width) return text;
    const std::string whole = text.text;
    for (std::size_t keep = whole.size(); keep > 4; --keep) {
        std::size_t head = keep / 2;
        std::size_t tail = whole.size() - (keep - head);
        // The text is not cut inside a UTF-8 sequence, nor inside a number, which would become a different number.
        const auto inside = [&whole](std::size_t at) {
            const auto in_number = [&whole](std::size_t k) {
                return (whole[k] >= '0' && whole[k] <= '9') || whole[k] == '.';
            };
            return at > 0 && at < whole.size() &&
                   ((static_cast<unsigned char>(whole[at]) & 0xC0) == 0x80 || (in_number(at - 1) && in_number(at)));
        };
        while (inside(head)) --head;
        while (inside(tail)) ++tail;
        text.text = whole.substr(0, head) + "…" + whole.substr(tail);
        if (text_width(text) <= width) return text;
    }
    text.text.clear();
    return text;
}

namespace {

/// The area of a text in the picture, with a margin for its smoothed edges.
PixelBox box_of(const FlatText& text, int height) {
    const Rect rect = text_rect(text);
    constexpr double room = 2;  // [px]
    const double top = height - text.y - 0.75 * text.size - room;
    return {static_cast<int>(std::floor(rect.x - room)), static_cast<int>(std::floor(top)),
            static_cast<int>(std::ceil(rect.width + 2 * room)) + 1,
            static_cast<int>(std::ceil(1.5 * text.size + 2 * room)) + 1};
}

/// The flat items of a sheet, without the image below them.
Drawing drawing_of(const Sheet& sheet) {
    Drawing drawing;
    drawing.width = sheet.width;
    drawing.height = sheet.height;
    drawing.background = sheet.background;
    drawing.quads = sheet.quads;
    drawing.lines = sheet.lines;
    std::stable_sort(drawing.lines.begin(), drawing.lines.end(),
                     [](const FlatLine& a, const FlatLine& b) { return a.level < b.level; });
    for (const FlatText& text : sheet.texts) {
        if (text.text.empty()) continue;
        drawing.texts.push_back(text);
        drawing.text_widths.push_back(text_width(text));
    }
    return drawing;
}

Image draw(const Sheet& sheet, const MeshSamples* meshes, const std::string& gl, int supersample) {
    Drawing::Ground ground;
    const bool has_ground = meshes != nullptr || !sheet.panels.empty();
    Image image =
        vtk_library().draw(sheet, meshes, gl, supersample, sheet.keep_drawing && has_ground ? &ground : nullptr);
    for (const FlatText& text : sheet.texts) image.texts.push_back(box_of(text, sheet.height));
    if (sheet.keep_drawing) {
        auto drawing = std::make_shared<Drawing>(drawing_of(sheet));
        if (has_ground) drawing->grounds.push_back(std::move(ground));
        image.drawing = std::move(drawing);
    }
    return image;
}

}  // namespace

Image draw(const Sheet& sheet, const std::string& gl, int supersample) { return draw(sheet, nullptr, gl, supersample); }

Image draw(const Sheet& flat, const MeshSamples& meshes, const std::string& gl, int supersample) {
    return draw(flat, &meshes, gl, supersample);
}

}  // namespace clsurf::viz
