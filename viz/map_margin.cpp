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

/// A bar of colours: its start, length and direction.
struct ColourBar {
    Vec2 start;
    double length, width;
    bool across;  ///< from left to right; otherwise from bottom to top

    [[nodiscard]] Vec2 at(double along, double aside) const {
        return across ? Vec2(start + Vec2(along, aside)) : Vec2(start + Vec2(aside, along));
    }
    void fill(Sheet& sheet, double from, double to, double low, double high, Rgb rgb) const {
        const Vec2 a = at(std::min(from, to), low);
        const Vec2 b = at(std::max(from, to), high);
        sheet.quads.push_back({{a.x(), a.y(), b.x() - a.x(), b.y() - a.y()}, rgb});
    }
};

/// If there are values beyond an end of the bar: a triangle in their colour.
void add_beyond(Sheet& sheet, const ColourScale& scale, bool above, const ColourBar& bar, double height, Rgb frame) {
    const Rgb rgb = above ? scale.map.above() : scale.map.below();
    const double end = above ? bar.length : 0;
    const double sign = above ? 1 : -1;
    constexpr int slices = 24;
    for (int k = 0; k < slices; ++k) {
        const double part = 1 - (k + 0.5) / slices;
        bar.fill(sheet, end + sign * height * k / slices, end + sign * (height * (k + 1) / slices + 0.3),
                 0.5 * bar.width * (1 - part), 0.5 * bar.width * (1 + part), rgb);
    }
    sheet.lines.push_back(
        {{bar.at(end, 0), bar.at(end + sign * height, 0.5 * bar.width), bar.at(end, bar.width)}, 1.0, frame});
}

/// The colours of a scale, with a frame.
void add_bar(Sheet& sheet, const ColourScale& scale, const ColourBar& bar, Rgb frame) {
    const int cells = scale.bins > 0 ? scale.bins : static_cast<int>(std::clamp(bar.length, 16.0, 512.0));
    for (int k = 0; k < cells; ++k) {
        const double value = scale.low + (scale.high - scale.low) * (k + 0.5) / cells;
        bar.fill(sheet, bar.length * k / cells, bar.length * (k + 1) / cells + 0.6, 0, bar.width, scale.colour(value));
    }
    sheet.lines.push_back(
        {{bar.at(0, 0), bar.at(0, bar.width), bar.at(bar.length, bar.width), bar.at(bar.length, 0), bar.at(0, 0)},
         1.0,
         frame});
}

/// A small rectangle with the hatching of places without a value.
void add_hatched(Sheet& sheet, const Rect& rect, Rgb frame) {
    const Vec2 corner(rect.x, rect.y);
    const Vec2 across(rect.width, 0);
    const Vec2 up(0, rect.height);
    const double step = 0.5 * rect.height;
    for (double at = step; at < rect.width + rect.height; at += step) {
        // From the lower or right edge up to the left or upper edge.
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

/// Round values; for a stepped scale its edges, as many as fit.
std::vector<double> legend_ticks(const ColourScale& scale, int wanted) {
    if (!(scale.high > scale.low)) return {scale.low};
    if (scale.bins == 0) return nice_ticks(scale.low, scale.high, std::max(2, wanted));
    std::vector<double> edges;
    const int each = (scale.bins - 1) / std::max(2, 2 * wanted) + 1;
    for (int k = each; k < scale.bins; k += each)
        edges.push_back(scale.low + (scale.high - scale.low) * k / scale.bins);
    return edges;
}

/// Notes from the top: each line takes as many as fit, and a long note is split between words. Beyond `most_lines`
/// the text is made smaller.
std::vector<FlatText> note_lines(const std::vector<std::string>& notes, FlatText note, double width,
                                 std::size_t most_lines) {
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

void add_notes(Sheet& sheet, const std::vector<std::string>& notes, const FlatText& note, double width,
               std::size_t most_lines) {
    std::vector<FlatText> lines = note_lines(notes, note, width, most_lines);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        lines[k].y += 1.25 * note.size * static_cast<double>(lines.size() - 1 - k);
        sheet.texts.push_back(fitted(std::move(lines[k]), width));
    }
}

/// The column of a wide picture: the title, one line for each part of the subtitle, and the notes at the bottom.
void add_title_column(Sheet& sheet, const MapTexts& texts, FlatText title, FlatText subtitle, const FlatText& note,
                      double width) {
    constexpr std::size_t most_notes = 8;
    constexpr std::string_view separator = " · ";
    const double below = add_wrapped(sheet, texts.title, std::move(title), width);
    subtitle.y = below - 0.5 * subtitle.size;
    for (std::size_t at = 0; at < texts.subtitle.size();) {
        const std::size_t end = std::min(texts.subtitle.find(separator, at), texts.subtitle.size());
        subtitle.y = add_wrapped(sheet, texts.subtitle.substr(at, end - at), subtitle, width);
        at = end + separator.size();
    }
    add_notes(sheet, texts.notes, note, width, most_notes);
}

}  // namespace

double add_wrapped(Sheet& sheet, const std::string& words, FlatText line, double room, std::size_t most_lines) {
    std::size_t finished = 0;
    const auto finish = [&] {
        sheet.texts.push_back(fitted(line, room));
        line.y -= 1.25 * line.size;
        ++finished;
    };
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        FlatText longer = line;
        longer.text += (line.text.empty() ? "" : " ") + words.substr(at, end - at);
        if (!line.text.empty() && finished + 1 < most_lines && text_width(longer) > room) {
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

void add_title(Sheet& sheet, const MapTexts& texts, double beside, const Look& look, const MapLayout& layout, Rgb ink) {
    constexpr std::size_t most_notes = 2;
    constexpr double most_smaller = 1.3;  // a longer title is shortened
    const Rgb grey = faint(ink, look.background);
    const double top = look.height - layout.margin;
    FlatText title{layout.margin, top - 0.5 * layout.text, "", 1.25 * layout.text, Align::left, true, ink};
    FlatText subtitle{layout.margin, top - 2.0 * layout.text, "", layout.small_text, Align::left, false, grey};
    const FlatText note{
        layout.margin, layout.margin * 0.5 + 0.5 * layout.small_text, "", layout.small_text, Align::left, false, grey};
    if (layout.arrangement == Arrangement::wide) {
        add_title_column(sheet, texts, title, subtitle, note, layout.title_width - 2 * layout.margin);
        return;
    }
    const double width = look.width - 2 * layout.margin;
    if (layout.arrangement == Arrangement::tall) {
        const double below = add_wrapped(sheet, texts.title, title, width);
        subtitle.y += below + 1.25 * title.size - title.y;
    } else {
        title.text = texts.title;
        title.size /= std::clamp(text_width(title) / width, 1.0, most_smaller);
        sheet.texts.push_back(fitted(std::move(title), width));
    }
    subtitle.text = texts.subtitle;
    sheet.texts.push_back(fitted(std::move(subtitle), width));
    add_notes(sheet, texts.notes, note, look.width - layout.margin - beside, most_notes);
}

namespace {

/// The quantity of a scale: "Path speed [mm/min]".
std::string name_of_scale(const FieldInfo& field) {
    return field.unit.name.empty() ? field.label : fmt::format("{} [{}]", field.label, field.unit.name);
}

/// Numbers and ticks next to a bar. The ends of the range are always given exactly; ticks too close to them are dropped.
void add_numbers(Sheet& sheet, const ColourScale& scale, const ColourBar& bar, const MapLayout& layout, Rgb ink,
                 Rgb frame) {
    constexpr double most_ticks = 10;
    const double between = (bar.across ? 5 : 3) * layout.text;
    const std::vector<double> ticks = legend_ticks(scale, static_cast<int>(std::min(most_ticks, bar.length / between)));
    double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    if (scale.bins > 0) step /= 10;  // the edges of steps are not round
    const double span = scale.high - scale.low;
    const double near = (bar.across ? 3.5 : 1.3) * layout.small_text / bar.length * span;
    const auto number = [&](double value, double digits, bool end) {
        const double along = span > 0 ? (value - scale.low) / span * bar.length : end ? 0 : 0.5 * bar.length;
        const double outside = bar.across ? 0 : bar.width;
        const double sign = bar.across ? -1 : 1;
        if (!end)
            sheet.lines.push_back(
                {{bar.at(along, outside), bar.at(along, outside + sign * 0.3 * layout.text)}, 1.0, frame});
        const Vec2 at = bar.at(along, outside + sign * (bar.across ? 0.95 : 0.5) * layout.text);
        add_text(sheet, at.x(), at.y(), tick_text(value, digits), layout.small_text,
                 bar.across ? Align::centre : Align::left, ink, end);
    };
    for (const double end : {scale.low, scale.high}) {
        if (!(span > 0) && end == scale.high) continue;
        number(end, scale.bins > 0 ? step : step / 10, true);
    }
    for (const double tick : ticks) {
        if (tick - scale.low < near || scale.high - tick < near) continue;
        number(tick, step, false);
    }
}

void add_no_value(Sheet& sheet, double x, double y, double width, const MapLayout& layout, Rgb ink, Rgb frame) {
    add_hatched(sheet, {x, y - 0.4 * layout.text, width, 0.8 * layout.text}, frame);
    add_text(sheet, x + width + 0.5 * layout.text, y, "no value", layout.small_text, Align::left, ink);
}

}  // namespace

void add_legend(Sheet& sheet, const ColourScale& scale, const FieldInfo& field, const Beyond& beyond, const Rect& room,
                const Look& look, const MapLayout& layout, Rgb ink) {
    const double t = layout.text;
    const Rgb frame = faint(ink, look.background);
    const double thickness = 1.3 * t;
    const double top = room.y + room.height;
    FlatText name{room.x + 0.6 * t, 0, "", layout.small_text, Align::left, true, ink};
    ColourBar bar{{name.x, 0}, 0, thickness, layout.arrangement == Arrangement::tall};
    if (bar.across) {
        name.x = layout.margin + 1.5 * t;
        name.y = top - 0.9 * t;
        const double below = add_wrapped(sheet, name_of_scale(field), name, room.width - 12 * t);
        bar.start = Vec2(name.x, below - 0.7 * t - 0.5 * thickness);
        bar.length = room.width - 2 * name.x;
        if (beyond.missing) add_no_value(sheet, room.width - 10 * t, name.y, thickness, layout, ink, frame);
    } else {
        name.y = top + 0.3 * t - 0.7 * layout.small_text;
        const double upper = add_wrapped(sheet, name_of_scale(field), name, room.x + room.width - 0.3 * t - name.x);
        const double bar_top = upper - 1.5 * t;
        bar.length = std::min(bar_top - room.y - 7.2 * t, 0.5 * room.height);
        bar.start.y() = bar_top - bar.length;
        if (bar.length < 3 * t) return;
        if (beyond.missing) add_no_value(sheet, name.x, bar.start.y() - 2.0 * t, thickness, layout, ink, frame);
    }
    add_bar(sheet, scale, bar, frame);
    add_numbers(sheet, scale, bar, layout, ink, frame);
    if (beyond.above) add_beyond(sheet, scale, true, bar, 0.9 * t, frame);
    if (beyond.below) add_beyond(sheet, scale, false, bar, 0.9 * t, frame);
}

void add_class_legend(Sheet& sheet, const std::vector<ShownClass>& classes, bool missing, const Rect& room,
                      const Look& look, const MapLayout& layout, Rgb ink) {
    const double t = layout.text;
    const double box = 0.9 * t;
    const double step = 1.5 * t;
    const Rgb frame = faint(ink, look.background);
    const double top = room.y + room.height - 1.2 * t;
    const auto most_columns = static_cast<std::size_t>(std::max(1.0, std::floor(room.width / layout.legend_width)));
    const auto in_a_column = static_cast<std::size_t>(std::max(1.0, std::floor((top - room.y) / step)));
    const std::size_t count = classes.size() + (missing ? 1 : 0);
    const bool short_columns = layout.arrangement == Arrangement::tall;
    const std::size_t rows = short_columns || count > in_a_column ? (count + most_columns - 1) / most_columns : count;
    const double column = most_columns > 1 ? layout.legend_width : room.width;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t columns_before = k / rows, row = k % rows;
        const double x = room.x + 0.6 * t + static_cast<double>(columns_before) * column;
        const double y = top - step * static_cast<double>(row);
        const Rect rect{x, y - 0.5 * box, 1.4 * t, box};
        std::string words = "no value";
        if (k < classes.size()) {
            sheet.quads.push_back({rect, classes[k].rgb});
            sheet.lines.push_back({{{rect.x, rect.y},
                                    {rect.x + rect.width, rect.y},
                                    {rect.x + rect.width, rect.y + rect.height},
                                    {rect.x, rect.y + rect.height},
                                    {rect.x, rect.y}},
                                   1.0,
                                   frame});
            words = fmt::format("{}  {}", classes[k].name, share_text(classes[k].share));
        } else {
            add_hatched(sheet, rect, frame);
        }
        sheet.texts.push_back(
            fitted({x + 2.0 * t, y, words, layout.small_text, Align::left, false, ink}, column - 3.0 * t));
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
    // Below the legend, clear of the map; with names, to the right of the key.
    const double across = look.names ? layout.legend_width - 3.0 * layout.text : 0.42 * layout.legend_width;
    const bool tall = layout.arrangement == Arrangement::tall;
    const Vec2 origin(tall ? look.width - 4.0 * layout.text : panel.rect.x + panel.rect.width + across,
                      3.4 * layout.text);
    const double length = 2.0 * layout.text;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 direction = Vec3::Unit(axis);
        const Vec2 flat(direction.dot(panel.camera.right), direction.dot(panel.camera.up));
        if (flat.norm() < 0.15) continue;  // it points at the viewer
        static constexpr Rgb colours[3] = {{200, 40, 40}, {30, 140, 50}, {40, 80, 200}};
        sheet.lines.push_back({{origin, origin + length * flat}, 2.0, colours[axis]});
        const Vec2 at = origin + (length + 0.55 * layout.text) * flat.normalized() * std::max(0.5, flat.norm());
        add_text(sheet, at.x(), at.y(), std::string(1, "XYZ"[axis]), layout.small_text, Align::centre, ink);
    }
}

}  // namespace clsurf::viz
