#include "viz/chart_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "viz/colour_map.h"

namespace clsurf::viz {
namespace {

/// About `wanted` round values, but at least two: a single one, such as 0, gives no scale.
std::vector<double> scale_ticks(double low, double high, int wanted) {
    constexpr int most_tries = 8;
    wanted = std::max(2, wanted);
    std::vector<double> ticks = nice_ticks(low, high, wanted);
    for (int k = 1; ticks.size() < 2 && k < most_tries; ++k) ticks = nice_ticks(low, high, ++wanted);
    return ticks;
}

}  // namespace

void ValueRange::widen(std::span<const double> values) {
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
}

void fit_y(ChartFrame& frame, ValueRange range, double room_share) {
    auto [low, high] = range;
    if (!(low <= high)) low = high = 0;
    const double room = high > low ? room_share * (high - low) : std::max(1.0, 0.05 * std::abs(high));
    frame.y_low = low - (low >= 0 && low < room ? low : room);
    frame.y_high = high + room;
}

std::vector<Vec2> thin_curve(std::span<const double> x, std::span<const double> y, double x_low, double x_high,
                             int columns) {
    std::vector<Vec2> out;
    const double per_x = x_high > x_low ? columns / (x_high - x_low) : 0;
    std::size_t i = 0;
    while (i < x.size()) {
        const double column = std::floor((x[i] - x_low) * per_x);
        std::size_t low = i;
        std::size_t high = i;
        std::size_t end = i;
        for (; end < x.size() && std::floor((x[end] - x_low) * per_x) == column; ++end) {
            // A gap is not an extreme; the first value after it is both the lowest and the highest.
            if (y[end] < y[low] || std::isnan(y[low])) low = end;
            if (y[end] > y[high] || std::isnan(y[high])) high = end;
        }
        const std::size_t picks[4] = {i, std::min(low, high), std::max(low, high), end - 1};
        for (std::size_t k = 0; k < 4; ++k) {
            if (k > 0 && picks[k] <= picks[k - 1]) continue;
            out.emplace_back(x[picks[k]], y[picks[k]]);
        }
        i = end;
    }
    return out;
}

void add_line(Sheet& sheet, const ChartFrame& f, std::span<const double> x, std::span<const double> values,
              FlatLine line) {
    for (const Vec2& p : thin_curve(x, values, f.x_low, f.x_high, static_cast<int>(f.rect.width))) {
        if (std::isfinite(p.y())) {
            line.points.push_back(f.at(p.x(), p.y()));
        } else if (!line.points.empty()) {
            sheet.lines.push_back(line);
            line.points.clear();
        }
    }
    if (!line.points.empty()) sheet.lines.push_back(std::move(line));
}

void add_y_axis(Sheet& sheet, const ChartFrame& f, double text) {
    const std::vector<double> ys = scale_ticks(f.y_low, f.y_high, static_cast<int>(f.rect.height / (3 * text)));
    const double y_step = ys.size() > 1 ? ys[1] - ys[0] : 1;
    double labelled = -std::numeric_limits<double>::infinity();
    for (const double y : ys) {
        const Vec2 p = f.at(f.x_low, y);
        sheet.lines.push_back({{p, {f.rect.x + f.rect.width, p.y()}}, 1, chart_grid, Level::area});
        if (p.y() - labelled < 1.05 * text) continue;  // the numbers would overlap
        labelled = p.y();
        sheet.texts.push_back(
            {f.rect.x - 0.5 * text, p.y(), tick_text(y, y_step), text, Align::right, false, chart_ink});
    }
    const Rect& r = f.rect;
    sheet.lines.push_back(
        {{{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}, {r.x, r.y}},
         1,
         {120, 120, 126},
         Level::edge});
}

void add_grid(Sheet& sheet, const ChartFrame& f, double text, bool x_labels) {
    add_x_grid(sheet, f, text, x_labels);
    add_y_axis(sheet, f, text);
}

void add_x_grid(Sheet& sheet, const ChartFrame& f, double text, bool x_labels) {
    const std::vector<double> xs = scale_ticks(f.x_low, f.x_high, static_cast<int>(f.rect.width / (7 * text)));
    const double x_step = xs.size() > 1 ? xs[1] - xs[0] : 1;
    double labelled = -std::numeric_limits<double>::infinity();
    for (const double x : xs) {
        const Vec2 p = f.at(x, f.y_low);
        sheet.lines.push_back({{p, {p.x(), f.rect.y + f.rect.height}}, 1, chart_grid, Level::area});
        if (!x_labels) continue;
        FlatText label{p.x(), f.rect.y - 0.9 * text, tick_text(x, x_step), text, Align::centre, false, chart_ink};
        const double half = 0.5 * text_width(label);
        if (p.x() - half < labelled + 0.3 * text) continue;
        labelled = p.x() + half;
        sheet.texts.push_back(std::move(label));
    }
}

}  // namespace clsurf::viz
