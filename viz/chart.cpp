#include "viz/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "viz/chart_frame.h"

namespace clsurf::viz {
namespace {

constexpr Rgb cursor_colour{200, 30, 30};
constexpr Rgb reference_colour{150, 150, 156};
// Safe for colour-blind readers (Okabe, Ito 2008).
constexpr Rgb curve_colours[] = {{0, 90, 178}, {213, 94, 0}, {0, 130, 95}, {160, 70, 130}, {110, 85, 0}};

/// A footnote split at blanks into lines of at most `ems` times the height of its letters, four at most.
std::vector<std::string> lines_of(const std::string& note, double ems) {
    constexpr double em_of_letter = 0.52;  // most letters are narrower
    constexpr std::size_t most_lines = 4;
    const auto room = static_cast<std::size_t>(std::max(20.0, ems / em_of_letter));
    std::vector<std::string> lines;
    std::string_view rest = note;
    while (!rest.empty() && lines.size() < most_lines) {
        std::size_t end = rest.size();
        if (end > room) {
            end = rest.rfind(' ', room);
            if (end == std::string_view::npos || end == 0) end = room;
        }
        lines.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(rest.size(), end + (end < rest.size() && rest[end] == ' ' ? 1 : 0)));
    }
    if (!rest.empty()) lines.back() += " …";
    return lines;
}

const CurveClass* class_of(const Curve& curve, double value) {
    const auto found =
        std::find_if(curve.classes.begin(), curve.classes.end(), [&](const CurveClass& c) { return c.value == value; });
    return found == curve.classes.end() ? nullptr : &*found;
}

/// Sections of one class as rectangles in its colour, at least one pixel wide.
void add_bands(Sheet& sheet, const ChartFrame& f, std::span<const double> x, const Curve& curve) {
    const double right = f.rect.x + f.rect.width;
    double drawn = f.rect.x;
    for (std::size_t i = 0; i < x.size();) {
        std::size_t end = i + 1;
        while (end < x.size() && curve.values[end] == curve.values[i]) ++end;
        const double to = end < x.size() ? std::max(f.at(x[end], 0).x(), drawn) : right;
        const CurveClass* known = class_of(curve, curve.values[i]);
        // Of several sections in one pixel only the first one is drawn.
        if (known != nullptr && to > drawn) {
            const double from = std::max(drawn, f.at(x[i], 0).x());
            const double width = std::min(right, std::max(to, from + 1)) - from;
            sheet.quads.push_back({{from, f.rect.y, width, f.rect.height}, known->rgb});
            drawn = from + width;
        }
        i = end;
    }
    const Rect& r = f.rect;
    sheet.lines.push_back({{{r.x, r.y}, {right, r.y}, {right, r.y + r.height}, {r.x, r.y + r.height}, {r.x, r.y}},
                           1,
                           {120, 120, 126},
                           Level::edge});
}

/// Names of classes with their colours, right-aligned above the frame; those without room are left out.
void add_class_names(Sheet& sheet, const ChartFrame& f, const Curve& curve, const FlatText& name) {
    const double text = name.size;
    double x = f.rect.x + text_width(name) + 2 * text;
    for (const CurveClass& c : curve.classes) {
        const FlatText label{x + 1.3 * text, name.y, c.name, text, Align::left, false, chart_ink};
        const double end = label.x + text_width(label) + 1.2 * text;
        if (end > f.rect.x + f.rect.width + text) return;
        sheet.quads.push_back({{x, name.y - 0.4 * text, 0.8 * text, 0.8 * text}, c.rgb});
        sheet.texts.push_back(label);
        x = end;
    }
}

/// A cursor in the frame, with its value above the frame, next to the curve's name, where no curve is drawn.
void add_cursor(Sheet& sheet, const ChartFrame& f, const ChartCursor& cursor, const Curve& curve, const FlatText& name,
                std::size_t k) {
    const double text = name.size;
    const Vec2 p = f.at(cursor.x, f.y_low);
    if (p.x() < f.rect.x || p.x() > f.rect.x + f.rect.width) return;
    sheet.lines.push_back({{p, {p.x(), f.rect.y + f.rect.height}}, 1.4, cursor_colour});
    const bool with_value = !cursor.values.empty();
    if (!with_value && k > 0) return;
    const CurveClass* known = with_value ? class_of(curve, cursor.values[k]) : nullptr;
    std::string words = cursor.label;
    if (with_value) {
        const std::string value =
            known != nullptr ? known->name : tick_text(cursor.values[k], std::max(1e-4, (f.y_high - f.y_low) / 1000));
        words = k == 0 ? words + ": " + value : value;
    }
    FlatText note{p.x(),        f.rect.y + f.rect.height + 0.9 * text, std::move(words), text, Align::left, true,
                  cursor_colour};
    const double least = f.rect.x + text_width({0, 0, name.text, text, Align::left, true, name.rgb}) + text;
    if (known != nullptr) note.y = f.rect.y + f.rect.height - 0.9 * text;  // the names of classes are above
    note.x =
        std::max(known != nullptr ? f.rect.x : least, std::min(note.x, f.rect.x + f.rect.width - text_width(note)));
    // The text may be over bands of any colour.
    if (known != nullptr) sheet.lines.push_back(halo_of(note, sheet.background));
    sheet.texts.push_back(std::move(note));
}

/// The curve over its reference, with the name of the reference.
void add_curve(Sheet& sheet, const ChartFrame& f, std::span<const double> x, const Curve& curve, const Rgb& colour,
               const FlatText& name) {
    if (!curve.reference.empty()) {
        add_line(sheet, f, x, curve.reference, {{}, 3.2, reference_colour, Level::edge});
        FlatText label = name;
        label.x += text_width(name) + 2 * name.size;
        label.text = curve.reference_label;
        label.rgb = reference_colour;
        sheet.texts.push_back(std::move(label));
    }
    add_line(sheet, f, x, curve.values, {{}, 1.4, colour});
}

}  // namespace

Sheet sheet_of(const ChartLook& look) {
    Sheet sheet;
    sheet.width = look.width;
    sheet.height = look.height;
    sheet.background = look.background;
    sheet.keep_drawing = look.keep_drawing;
    return sheet;
}

double text_size_of(const ChartLook& look, double lines) {
    return std::clamp(std::min(look.width * 0.6, static_cast<double>(look.height)) / lines, 8.0, 40.0);
}

Image draw_chart(std::span<const double> x, const std::vector<Curve>& curves, const std::vector<ChartCursor>& cursors,
                 const ChartLook& look) {
    const double text = text_size_of(look, 44);
    Sheet sheet = sheet_of(look);
    const double left = 6.5 * text;
    const double right = 1.5 * text;
    const double top = 4.6 * text;
    const std::vector<std::string> notes = lines_of(look.footnote, (look.width - 2 * text) / (0.85 * text));
    const double below = 1.1 * text * (notes.empty() ? 0.0 : static_cast<double>(notes.size() - 1));
    const double bottom = 5.2 * text + below;
    const double gap = 2.4 * text;
    sheet.texts.push_back({text, look.height - 1.4 * text, look.title, 1.4 * text, Align::left, true, chart_ink});
    sheet.texts.push_back({text, look.height - 3.0 * text, look.subtitle, text, Align::left, false, chart_faint});
    sheet.texts.push_back({left, 2.6 * text + below, look.x_label, text, Align::left, true, chart_ink});
    for (std::size_t k = 0; k < notes.size(); ++k) {
        const double y = 1.0 * text + below - 1.1 * text * static_cast<double>(k);
        sheet.texts.push_back({text, y, notes[k], 0.85 * text, Align::left, false, chart_faint});
    }
    const auto count = static_cast<double>(curves.size());
    const double each = (look.height - top - bottom - gap * count) / count;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        ChartFrame f;
        f.rect = {left, bottom + (count - 1 - static_cast<double>(k)) * (each + gap), look.width - left - right,
                  std::max(1.0, each)};
        f.x_low = x.empty() ? 0 : x.front();
        f.x_high = x.empty() ? 1 : x.back();
        ValueRange range;
        range.widen(curves[k].values);
        range.widen(curves[k].reference);
        fit_y(f, range, 0.05);
        if (curves[k].classes.empty())
            add_grid(sheet, f, text, k + 1 == curves.size());
        else
            add_x_grid(sheet, f, text, k + 1 == curves.size());
        const Rgb colour = curve_colours[k % std::size(curve_colours)];
        const FlatText name{f.rect.x, f.rect.y + f.rect.height + 0.9 * text, curves[k].label, text, Align::left, true,
                            colour};
        sheet.texts.push_back(name);
        if (!curves[k].classes.empty()) {
            add_bands(sheet, f, x, curves[k]);
            add_class_names(sheet, f, curves[k], name);
        } else {
            add_curve(sheet, f, x, curves[k], colour, name);
        }
        for (const ChartCursor& cursor : cursors) add_cursor(sheet, f, cursor, curves[k], name, k);
    }
    return draw(sheet, look.gl, look.supersample);
}

}  // namespace clsurf::viz
