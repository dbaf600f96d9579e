// PDF with Cairo: a part of the shared library behind image_library.h, and the only code that uses Cairo.

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "viz/drawing.h"
#include "viz/image_pdf.h"

namespace clsurf::viz {
namespace {

constexpr double points_a_pixel = 0.75;
constexpr double baseline = 0.35;  ///< distance of the baseline below the middle of a line, in text sizes
constexpr double narrowest = 0.7;  ///< horizontal scale of letters, if the font differs from the measured one

struct Sink {
    void* context;
    void (*write)(void*, const void*, std::size_t);
};

cairo_status_t write(void* closure, const unsigned char* data, unsigned int size) {
    const auto* sink = static_cast<Sink*>(closure);
    sink->write(sink->context, data, size);
    return CAIRO_STATUS_SUCCESS;
}

void set_colour(cairo_t* page, const Rgb& rgb) {
    cairo_set_source_rgb(page, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

void draw_ground(cairo_t* page, const Drawing::Ground& ground, double height) {
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, ground.width);
    std::vector<unsigned char> rows(static_cast<std::size_t>(stride) * static_cast<std::size_t>(ground.height));
    const std::uint8_t* rgb = ground.rgb.data();
    for (int y = 0; y < ground.height; ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(rows.data() + static_cast<std::ptrdiff_t>(y) * stride);
        for (int x = 0; x < ground.width; ++x, rgb += 3)
            row[x] = std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2];
    }
    cairo_surface_t* image =
        cairo_image_surface_create_for_data(rows.data(), CAIRO_FORMAT_RGB24, ground.width, ground.height, stride);
    const Rect& r = ground.place;
    cairo_save(page);
    cairo_translate(page, r.x, height - r.y - r.height);
    cairo_scale(page, r.width / ground.width, r.height / ground.height);
    cairo_set_source_surface(page, image, 0, 0);
    cairo_paint(page);
    cairo_restore(page);
    cairo_surface_finish(image);  // the page has a copy; `rows` is not used after this
    cairo_surface_destroy(image);
}

void draw_line(cairo_t* page, const FlatLine& line, double height) {
    set_colour(page, line.rgb);
    cairo_set_line_width(page, line.width);
    cairo_save(page);
    if (line.clip) {
        const Rect& r = *line.clip;
        cairo_rectangle(page, r.x, height - r.y - r.height, r.width, r.height);
        cairo_clip(page);
    }
    for (const Vec2& point : outline_of(line)) cairo_line_to(page, point.x(), height - point.y());
    if (line.opposite.empty())
        cairo_stroke(page);
    else
        cairo_fill(page);
    cairo_restore(page);
}

/// Fits the text to its measured width, whatever font is installed.
void draw_text(cairo_t* page, const FlatText& text, double width, double height) {
    cairo_select_font_face(page, "Arial", CAIRO_FONT_SLANT_NORMAL,
                           text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(page, text.size);
    cairo_text_extents_t extents;
    cairo_text_extents(page, text.text.c_str(), &extents);
    const double own = extents.x_advance;
    const double scale = own > 0 ? std::clamp(width / own, narrowest, 1.0) : 1.0;
    cairo_save(page);
    cairo_translate(page, text.x - share_at_left(text.align) * scale * own, height - text.y + baseline * text.size);
    cairo_scale(page, scale, 1);
    set_colour(page, text.rgb);
    cairo_move_to(page, 0, 0);
    cairo_show_text(page, text.text.c_str());
    cairo_restore(page);
}

}  // namespace

bool write_pdf(const Drawing& drawing, const char* title, void* context,
               void (*sink)(void* context, const void* bytes, std::size_t size)) {
    Sink to{context, sink};
    const double height = drawing.height;
    cairo_surface_t* surface =
        cairo_pdf_surface_create_for_stream(write, &to, points_a_pixel * drawing.width, points_a_pixel * height);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "clsurf");
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");  // makes the bytes reproducible
    cairo_t* page = cairo_create(surface);
    cairo_scale(page, points_a_pixel, points_a_pixel);
    set_colour(page, drawing.background);
    cairo_paint(page);
    for (const Drawing::Ground& ground : drawing.grounds) draw_ground(page, ground, height);
    for (const FlatQuad& quad : drawing.quads) {
        set_colour(page, quad.rgb);
        cairo_rectangle(page, quad.rect.x, height - quad.rect.y - quad.rect.height, quad.rect.width, quad.rect.height);
        cairo_fill(page);
    }
    cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
    for (const FlatLine& line : drawing.lines) draw_line(page, line, height);
    for (std::size_t i = 0; i < drawing.texts.size(); ++i)
        draw_text(page, drawing.texts[i], drawing.text_widths[i], height);
    cairo_show_page(page);
    const bool done = cairo_status(page) == CAIRO_STATUS_SUCCESS;
    cairo_destroy(page);
    cairo_surface_finish(surface);
    const bool written = cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS;
    cairo_surface_destroy(surface);
    return done && written;
}

}  // namespace clsurf::viz
