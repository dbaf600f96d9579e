#include "viz/defect_card.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "viz/chart.h"
#include "viz/chart_frame.h"
#include "viz/drawing.h"
#include "viz/map_margin.h"

namespace clsurf::viz {
namespace {

constexpr Rgb band_colour{226, 234, 244};
constexpr Rgb marked_colour{235, 170, 90};
constexpr double title_share = 0.15;  ///< share of the height
constexpr double map_share = 0.36;    ///< share of the width
constexpr double foot_share = 0.02;
constexpr double axes_room =
    3.2;  ///< distance from the middle of the axes to the right end of the strip, in text sizes
constexpr double bearings_lines = 3.4;  ///< height of the strip below the map, in text sizes

double text_size(int width, int height) { return std::clamp(std::min(width * 0.4, height * 1.0) / 34.0, 8.0, 40.0); }

/// Fits the frame to all curves and the band, with a small margin.
void fit(ChartFrame& frame, const CardChart& chart) {
    ValueRange range;
    for (const CardCurve& curve : chart.curves) range.widen(curve.values);
    range.widen(chart.band_low);
    range.widen(chart.band_high);
    frame.x_low = chart.x.empty() ? 0 : chart.x.front();
    frame.x_high = chart.x.empty() ? 1 : chart.x.back();
    // Dots at the ends keep clear of the numbers next to the frame.
    const double beside = chart.dots ? 0.04 * (frame.x_high - frame.x_low) : 0;
    frame.x_low -= beside;
    frame.x_high += beside;
    fit_y(frame, range, 0.07);
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `most` > 0.
double round_length(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

class CardDrawer {
public:
    CardDrawer(Sheet& sheet, double text) : sheet_(sheet), text_(text) {}

    void chart(const CardChart& chart, const Rect& rect) {
        ChartFrame frame;
        frame.rect = rect;
        fit(frame, chart);
        if (chart.marked_to > chart.marked_from) section(frame, chart.marked_from, chart.marked_to);
        band(frame, chart);
        add_grid(sheet_, frame, 0.9 * text_, true);
        const double scale = text_ / 18;
        for (const CardCurve& curve : chart.curves) {
            add_line(sheet_, frame, chart.x, curve.values, {{}, curve.width * scale, curve.rgb, Level::line});
            if (!chart.dots) continue;
            for (std::size_t i = 0; i < chart.x.size(); ++i) {
                if (std::isfinite(curve.values[i]))
                    dot(frame.at(chart.x[i], curve.values[i]), curve.rgb,
                        &curve == &chart.curves.back() ? Level::dot_fill : Level::dot);
            }
        }
        for (const double x : chart.ticks) {
            const Vec2 p = frame.at(x, frame.y_low);
            sheet_.lines.push_back({{p, p + Vec2(0, 0.45 * text_)}, 1.0, chart_faint, Level::line});
        }
        const double top = rect.y + rect.height;
        sheet_.texts.push_back(
            fitted({rect.x, top + 0.85 * text_, chart.title, text_, Align::left, true, chart_ink}, rect.width));
        const FlatText name{rect.x + rect.width, rect.y - 2.0 * text_, chart.x_label, 0.9 * text_, Align::right, false,
                            chart_faint};
        const double name_left = name.x - text_width(name);
        double next = -std::numeric_limits<double>::infinity();
        for (const auto& [x, words] : chart.tick_labels) {
            FlatText label{frame.at(x, frame.y_low).x(),
                           rect.y - 2.0 * text_,
                           words,
                           0.9 * text_,
                           Align::left,
                           false,
                           chart_faint};
            if (label.x < next || label.x + text_width(label) > name_left - text_) continue;
            next = label.x + text_width(label) + 0.5 * text_;
            sheet_.texts.push_back(std::move(label));
        }
        sheet_.texts.push_back(name);
    }

    /// Scale bar, direction of feed and axes of the part, in a strip with a given width and middle height.
    void bearings(const CardBearings& b, double width, double y) {
        if (!(b.mm_per_pixel > 0)) return;
        const double length = round_length(0.26 * width * b.mm_per_pixel);
        const double x = text_, bar = length / b.mm_per_pixel;
        stroke({x, y}, {x + bar, y}, 0.14);
        for (const double end : {x, x + bar}) stroke({end, y - 0.35 * text_}, {end, y + 0.35 * text_}, 0.14);
        words({x + bar + 0.5 * text_, y}, fmt::format("{:g} mm", length), Align::left);
        if (b.feed.norm() > 0.1) {
            const Vec2 middle(0.56 * width, y), half = 1.2 * text_ * b.feed.normalized();
            arrow(middle - half, middle + half);
            words({middle.x() + 1.7 * text_, y}, "feed", Align::left);
        }
        axes(b.axes, Vec2(width - axes_room * text_, y));
    }

    void key(const DefectCard& card, double right, double y) {
        const auto entry = [&](const std::string& words, const Rgb& rgb, double width) {
            FlatText label{right, y, words, 0.9 * text_, Align::right, false, chart_ink};
            right -= text_width(label) + 0.4 * text_;
            sheet_.lines.push_back({{{right - 1.6 * text_, y}, {right, y}}, width, rgb, Level::line});
            right -= 2.8 * text_;
            sheet_.texts.push_back(std::move(label));
        };
        entry("section at fault", marked_colour, 0.35 * text_);
        if (!card.band_name.empty()) entry(card.band_name, band_colour, 0.8 * text_);
        for (std::size_t k = card.key.size(); k-- > 0;) entry(card.key[k].name, card.key[k].rgb, 0.16 * text_);
    }

private:
    /// The axes of the part with their letters; the middle of the whole symbol is at `middle`.
    void axes(const std::array<Vec2, 3>& directions, const Vec2& middle) {
        constexpr double length = 1.3, to_letter = 1.85, least_seen = 0.35;
        Vec2 low = Vec2::Zero(), high = Vec2::Zero();
        for (const Vec2& direction : directions) {
            if (direction.norm() < least_seen) continue;  // towards the viewer
            low = low.cwiseMin(to_letter * text_ * direction);
            high = high.cwiseMax(to_letter * text_ * direction);
        }
        const Vec2 origin = middle - 0.5 * (low + high);
        for (std::size_t k = 0; k < directions.size(); ++k) {
            if (directions[k].norm() < least_seen) continue;
            stroke(origin, origin + length * text_ * directions[k], 0.1);
            words(origin + to_letter * text_ * directions[k], std::string(1, "XYZ"[k]), Align::centre);
        }
    }

    void stroke(const Vec2& from, const Vec2& to, double width) {
        sheet_.lines.push_back({{from, to}, width * text_, chart_ink, Level::line});
    }

    void arrow(const Vec2& from, const Vec2& to) {
        stroke(from, to, 0.14);
        const Vec2 back = 0.3 * (from - to), aside(0.6 * back.y(), -0.6 * back.x());
        for (const double side : {-1.0, 1.0}) stroke(to + back + side * aside, to, 0.14);
    }

    void words(const Vec2& at, const std::string& text, Align align) {
        sheet_.texts.push_back({at.x(), at.y(), text, 0.9 * text_, align, false, chart_ink});
    }

    void dot(const Vec2& at, const Rgb& rgb, Level level) {
        const double r = 0.22 * text_;
        sheet_.lines.push_back({{at - Vec2(r, 0), at + Vec2(r, 0)}, 2 * r, rgb, level});
    }

    /// A bar along the upper edge, and lines down from its ends.
    void section(const ChartFrame& frame, double from, double to) {
        const double x0 = std::max(frame.rect.x, frame.at(from, 0).x());
        const double x1 = std::min(frame.rect.x + frame.rect.width, frame.at(to, 0).x());
        const double top = frame.rect.y + frame.rect.height;
        const double bar = 0.35 * text_;
        sheet_.quads.push_back({{x0, top - bar, std::max(1.0, x1 - x0), bar}, marked_colour});
        for (const double x : {x0, x1})
            sheet_.lines.push_back({{{x, frame.rect.y}, {x, top}}, 0.08 * text_, marked_colour, Level::edge});
    }

    void band(const ChartFrame& frame, const CardChart& chart) {
        for (std::size_t i = 1; i < chart.band_low.size(); ++i) {
            if (!std::isfinite(chart.band_low[i]) || !std::isfinite(chart.band_high[i])) continue;
            const Vec2 low = frame.at(chart.x[i - 1], chart.band_low[i]);
            const Vec2 high = frame.at(chart.x[i], chart.band_high[i]);
            sheet_.quads.push_back({{low.x(), low.y(), high.x() - low.x() + 0.3, high.y() - low.y()}, band_colour});
        }
    }

    Sheet& sheet_;
    double text_;
};

/// Copies a picture onto another, `y` from the top.
void paste(Image& onto, const Image& picture, int x, int y) {
    for (int row = 0; row < picture.height; ++row) {
        const std::uint8_t* from = picture.pixel(0, row);
        std::copy(from, from + 3 * picture.width, onto.rgb.data() + (onto.pixel(x, y + row) - onto.rgb.data()));
    }
    for (PixelBox box : picture.texts) {
        box.x += x;
        box.y += y;
        onto.texts.push_back(box);
    }
}

}  // namespace

CardMapSize card_map_size(int width, int height) {
    return {static_cast<int>(map_share * width),
            static_cast<int>((1 - title_share - foot_share) * height - bearings_lines * text_size(width, height))};
}

Image draw_card(const DefectCard& card, int width, int height, const std::string& gl) {
    const double text = text_size(width, height);
    Sheet sheet;
    sheet.width = width;
    sheet.height = height;
    sheet.keep_drawing = card.map.drawing != nullptr;
    CardDrawer drawer(sheet, text);
    const double margin = text;
    sheet.texts.push_back(fitted({margin, height - 1.5 * text, card.title, 1.35 * text, Align::left, true, chart_ink},
                                 width - 2 * margin));
    constexpr std::size_t subtitle_lines = 2;  // number of lines that fit above the key
    (void)add_wrapped(sheet, card.subtitle,
                      {margin, height - 3.2 * text, "", 0.9 * text, Align::left, false, chart_faint},
                      width - 2 * margin, subtitle_lines);
    const double left = map_share * width + 5.2 * text;
    const double right = width - margin;
    const double top = (1 - title_share) * height - 2.3 * text;
    drawer.bearings(card.bearings, map_share * width, foot_share * height + 0.5 * bearings_lines * text);
    drawer.key(card, right, (1 - title_share) * height + 0.7 * text);
    const double bottom = 3.2 * text;
    const double gap = 4.6 * text;
    const double row = 0.5 * (top - bottom - gap);
    if (!card.charts.empty()) drawer.chart(card.charts[0], {left, bottom + row + gap, right - left, row});
    const std::size_t below = card.charts.size() > 1 ? card.charts.size() - 1 : 0;
    for (std::size_t k = 0; k < below; ++k) {
        const double between = 5.0 * text;
        const double each = (right - left - between * static_cast<double>(below - 1)) / static_cast<double>(below);
        drawer.chart(card.charts[k + 1], {left + static_cast<double>(k) * (each + between), bottom, each, row});
    }
    Image image = draw(sheet, gl, 2);
    const int top_of_map = static_cast<int>(title_share * height);
    paste(image, card.map, 0, top_of_map);
    if (sheet.keep_drawing) {
        auto whole = std::make_shared<Drawing>(*image.drawing);
        add(*whole, *card.map.drawing, 0, height - top_of_map - card.map.height);
        image.drawing = std::move(whole);
    }
    return image;
}

}  // namespace clsurf::viz
