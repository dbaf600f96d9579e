#include "viz/map_margin.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace clsurf::viz {
namespace {

void add_text(Sheet& sheet, double x, double y, std::string text, double size, Align align, Rgb rgb,
              bool bold = false) {
    sheet.texts.push_back({x, y, std::move(text), size, align, bold, rgb});
}

/// Beyond an end of the bar there are values: a point of the colour that they have.
void add_beyond(Sheet& sheet, const ColourScale& scale, bool above, double x, double width, double y, double height,
                Rgb frame) {
    const Rgb rgb = above ? scale.map.above() : scale.map.below();
    const double sign = above ? 1 : -1;
    constexpr int slices = 24;
    for (int k = 0; k < slices; ++k) {
        const double part = 1 - (k + 0.5) / slices;
        const double low = sign > 0 ? y + height * k / slices : y - height * (k + 1) / slices;
        sheet.quads.push_back({{x + 0.5 * width * (1 - part), low, width * part, height / slices + 0.3}, rgb});
    }
    sheet.lines.push_back({{{x, y}, {x + 0.5 * width, y + sign * height}, {x + width, y}}, 1.0, frame});
}

/// A small field with the hatching of places without a value.
void add_hatched(Sheet& sheet, const Rect& rect, Rgb frame) {
    const Vec2 corner(rect.x, rect.y);
    const Vec2 across(rect.width, 0);
    const Vec2 up(0, rect.height);
    const double step = 0.5 * rect.height;
    for (double at = step; at < rect.width + rect.height; at += step) {
        // From the lower edge, or the right one, up to the left edge, or the upper one.
        const Vec2 from = at < rect.width ? Vec2(at, 0) : Vec2(rect.width, at - rect.width);
        const Vec2 to = at < rect.height ? Vec2(0, at) : Vec2(at - rect.height, rect.height);
        sheet.lines.push_back({{corner + from, corner + to}, 1.0, missing_colour});
    }
    sheet.lines.push_back({{corner, corner + across, corner + across + up, corner + up, corner}, 1.0, frame});
}

/// "41 %", "0.3 %", "< 0.1 %".
std::string share_text(double share) {
    const double percent = 100 * share;
    if (percent < 0.1) return "< 0.1 %";
    return percent < 10 ? fmt::format("{:.1f} %", percent) : fmt::format("{:.0f} %", percent);
}

/// Round values; where the colours are steps, their edges, as many as have room.
std::vector<double> legend_ticks(const ColourScale& scale, int wanted) {
    if (!(scale.high > scale.low)) return {scale.low};
    if (scale.bins == 0) return nice_ticks(scale.low, scale.high, std::max(2, wanted));
    std::vector<double> edges;
    const int each = (scale.bins - 1) / std::max(2, 2 * wanted) + 1;
    for (int k = each; k < scale.bins; k += each)
        edges.push_back(scale.low + (scale.high - scale.low) * k / scale.bins);
    return edges;
}

/// Notes from the top: a line takes as many as fit, and a long one goes on at a word. There is room for two lines; what
/// does not fit into them is written smaller.
std::vector<FlatText> note_lines(const std::vector<std::string>& notes, FlatText note, double width) {
    constexpr std::size_t most_lines = 2;
    constexpr double smaller = 0.95, smallest = 0.7;
    const double usual = note.size;
    std::vector<FlatText> lines;
    for (; note.size >= smallest * usual; note.size *= smaller) {
        lines.clear();
        for (const std::string& each : notes) {
            std::string_view separator = lines.empty() ? "" : "; ";
            for (std::size_t at = 0; at < each.size();) {
                const std::size_t end = std::min(each.find(' ', at), each.size());
                const std::string word = each.substr(at, end - at);
                FlatText longer = note;
                if (!lines.empty()) longer.text = lines.back().text;
                longer.text.append(separator).append(word);
                if (lines.empty() || text_width(longer) > width) {
                    lines.push_back(note);
                    lines.back().text = word;
                } else {
                    lines.back() = std::move(longer);
                }
                separator = " ";
                at = end + 1;
            }
        }
        if (lines.size() <= most_lines) break;
    }
    if (lines.size() > most_lines) lines.resize(most_lines);
    return lines;
}

}  // namespace

void add_title(Sheet& sheet, const MapTexts& texts, double beside, const Look& look, const MapLayout& layout, Rgb ink) {
    const double width = look.width - 2 * layout.margin;
    const double top = look.height - layout.margin;
    sheet.texts.push_back(fitted(
        {layout.margin, top - 0.5 * layout.text, texts.title, 1.25 * layout.text, Align::left, true, ink}, width));
    sheet.texts.push_back(fitted({layout.margin, top - 2.0 * layout.text, texts.subtitle, layout.small_text,
                                  Align::left, false, faint(ink, look.background)},
                                 width));
    FlatText note{layout.margin,
                  layout.margin * 0.5 + 0.5 * layout.small_text,
                  "",
                  layout.small_text,
                  Align::left,
                  false,
                  faint(ink, look.background)};
    const double note_width = look.width - layout.margin - beside;
    std::vector<FlatText> lines = note_lines(texts.notes, note, note_width);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        lines[k].y += 1.25 * layout.small_text * static_cast<double>(lines.size() - 1 - k);
        sheet.texts.push_back(fitted(std::move(lines[k]), note_width));
    }
}

namespace {

/// Name and unit of a field in as many lines as they need, from `top` down. Returns where they end [px].
double add_field_name(Sheet& sheet, const FieldInfo& field, double x, double top, double room, const MapLayout& layout,
                      Rgb ink) {
    std::string words = field.label;
    if (!field.unit.name.empty()) words += fmt::format(" [{}]", field.unit.name);
    FlatText line{x, top - 0.7 * layout.small_text, "", layout.small_text, Align::left, true, ink};
    const auto finish = [&] {
        sheet.texts.push_back(fitted(line, room));
        line.y -= 1.25 * layout.small_text;
    };
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        FlatText longer = line;
        longer.text += (line.text.empty() ? "" : " ") + words.substr(at, end - at);
        if (!line.text.empty() && text_width(longer) > room) {
            finish();
            line.text = words.substr(at, end - at);
        } else {
            line.text = longer.text;
        }
        at = end + 1;
    }
    finish();
    return line.y;
}

}  // namespace

void add_legend(Sheet& sheet, const ColourScale& scale, const FieldInfo& field, const Beyond& beyond, const Look& look,
                const MapLayout& layout, Rgb ink) {
    const double x = look.width - layout.legend_width + 0.6 * layout.text;
    const double bar_width = 1.3 * layout.text;
    const double room = look.width - 0.3 * layout.text - x;
    const double above_name = look.height - layout.title_height + 0.3 * layout.text;
    const double top = add_field_name(sheet, field, x, above_name, room, layout, ink) - 1.5 * layout.text;
    const double lowest = layout.note_height + 7.2 * layout.text;
    const double half = 0.5 * (look.height - layout.title_height - layout.note_height);
    const double height = std::min(top - lowest, half);
    const double bottom = top - height;
    if (height < 3 * layout.text) return;
    const int cells = scale.bins > 0 ? scale.bins : static_cast<int>(std::clamp(height, 16.0, 512.0));
    for (int k = 0; k < cells; ++k) {
        const double value = scale.low + (scale.high - scale.low) * (k + 0.5) / cells;
        sheet.quads.push_back({{x, bottom + height * k / cells, bar_width, height / cells + 0.6}, scale.colour(value)});
    }
    const Rgb frame = faint(ink, look.background);
    sheet.lines.push_back(
        {{{x, bottom}, {x + bar_width, bottom}, {x + bar_width, top}, {x, top}, {x, bottom}}, 1.0, frame});
    const std::vector<double> ticks = legend_ticks(scale, static_cast<int>(height / (3 * layout.text)));
    double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    if (scale.bins > 0) step /= 10;  // the edges of steps are not round
    // The ends of the range stand there exactly; ticks too near to them give way.
    const double near = 1.3 * layout.small_text / height * (scale.high - scale.low);
    for (const double end : {scale.low, scale.high}) {
        if (!(scale.high > scale.low) && end == scale.high) continue;
        const double y = end == scale.low ? bottom : top;
        add_text(sheet, x + bar_width + 0.5 * layout.text, y, tick_text(end, scale.bins > 0 ? step : step / 10),
                 layout.small_text, Align::left, ink, true);
    }
    for (const double tick : ticks) {
        if (tick - scale.low < near || scale.high - tick < near) continue;
        const double t = scale.high > scale.low ? (tick - scale.low) / (scale.high - scale.low) : 0.5;
        const double y = bottom + t * height;
        sheet.lines.push_back({{{x + bar_width, y}, {x + bar_width + 0.3 * layout.text, y}}, 1.0, frame});
        add_text(sheet, x + bar_width + 0.5 * layout.text, y, tick_text(tick, step), layout.small_text, Align::left,
                 ink);
    }
    const double point = 0.9 * layout.text;
    if (beyond.above) add_beyond(sheet, scale, true, x, bar_width, top, point, frame);
    if (beyond.below) add_beyond(sheet, scale, false, x, bar_width, bottom, point, frame);
    if (beyond.missing) {
        const double y = bottom - 2.0 * layout.text;
        add_hatched(sheet, {x, y - 0.4 * layout.text, bar_width, 0.8 * layout.text}, frame);
        add_text(sheet, x + bar_width + 0.5 * layout.text, y, "no value", layout.small_text, Align::left, ink);
    }
}

void add_class_legend(Sheet& sheet, const std::vector<ShownClass>& classes, bool missing, const Look& look,
                      const MapLayout& layout, Rgb ink) {
    const double t = layout.text;
    const double x = look.width - layout.legend_width + 0.6 * t;
    const double box = 0.9 * t;
    const Rgb frame = faint(ink, look.background);
    double y = look.height - layout.title_height - 1.2 * t;
    const double room = look.width - 0.4 * t - (x + 2.0 * t);
    const auto row = [&](const std::string& words) {
        sheet.texts.push_back(fitted({x + 2.0 * t, y, words, layout.small_text, Align::left, false, ink}, room));
        y -= 1.5 * t;
    };
    for (const ShownClass& shown : classes) {
        const Rect rect{x, y - 0.5 * box, 1.4 * t, box};
        sheet.quads.push_back({rect, shown.rgb});
        sheet.lines.push_back({{{rect.x, rect.y},
                                {rect.x + rect.width, rect.y},
                                {rect.x + rect.width, rect.y + rect.height},
                                {rect.x, rect.y + rect.height},
                                {rect.x, rect.y}},
                               1.0,
                               frame});
        row(fmt::format("{}  {}", shown.name, share_text(shown.share)));
    }
    if (missing) {
        add_hatched(sheet, {x, y - 0.5 * box, 1.4 * t, box}, frame);
        row("no value");
    }
}

void add_scale_bar(Sheet& sheet, const MeshPanel& panel, const MapLayout& layout, Rgb ink) {
    const double wanted = 0.22 * panel.rect.width * panel.camera.mm_per_pixel;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    double length = power;
    for (const double factor : {2.0, 5.0}) {
        if (factor * power <= wanted) length = factor * power;
    }
    const double pixels = length / panel.camera.mm_per_pixel;
    const double x = panel.rect.x + panel.rect.width - layout.margin - pixels;
    const double y = 0.55 * layout.margin + 0.2 * layout.text;
    const double tick = 0.35 * layout.text;
    sheet.lines.push_back({{{x, y + tick}, {x, y - tick}}, 1.5, ink});
    sheet.lines.push_back({{{x, y}, {x + pixels, y}}, 1.5, ink});
    sheet.lines.push_back({{{x + pixels, y + tick}, {x + pixels, y - tick}}, 1.5, ink});
    add_text(sheet, x + 0.5 * pixels, y + 0.9 * layout.text, fmt::format("{:g} mm", length), layout.small_text,
             Align::centre, ink);
}

void add_axes(Sheet& sheet, const MeshPanel& panel, const Look& look, const MapLayout& layout, Rgb ink) {
    // Below the legend, where no map can be under it; right of the key where there are names.
    const double across = look.names ? MapLayout(look).legend_width - 3.0 * layout.text : 0.42 * layout.legend_width;
    const Vec2 origin(panel.rect.x + panel.rect.width + across, 3.4 * layout.text);
    const double length = 2.0 * layout.text;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 direction = Vec3::Unit(axis);
        const Vec2 flat(direction.dot(panel.camera.right), direction.dot(panel.camera.up));
        if (flat.norm() < 0.15) continue;  // it points at the eye
        static constexpr Rgb colours[3] = {{200, 40, 40}, {30, 140, 50}, {40, 80, 200}};
        sheet.lines.push_back({{origin, origin + length * flat}, 2.0, colours[axis]});
        const Vec2 at = origin + (length + 0.55 * layout.text) * flat.normalized() * std::max(0.5, flat.norm());
        add_text(sheet, at.x(), at.y(), std::string(1, "XYZ"[axis]), layout.small_text, Align::centre, ink);
    }
}

}  // namespace clsurf::viz
