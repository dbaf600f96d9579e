#include "io/page/svg_chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/page/html_text.h"

namespace clsurf::io {
namespace {

constexpr double chart_width = 860;  // in the chart's coordinates; the page scales it
constexpr double chart_height = 240;
constexpr double margin_left = 58;
constexpr double margin_right = 14;
constexpr double margin_top = 16;
constexpr double margin_bottom = 38;

/// A step of 1, 2 or 5 times a power of ten, about a fifth of the range.
double round_step(double range) {
    const double rough = range / 5;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double mantissa = rough / power;
    return power * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

struct SvgScale {
    double high = 1, step = 0.2;  ///< end and step of an axis that begins at 0

    SvgScale(double most, bool counts) {
        if (!(most > 0)) most = 1;
        step = counts ? std::max(1.0, round_step(most)) : round_step(most);
        high = step * std::ceil(most * 1.04 / step);
    }
    [[nodiscard]] double y(double value) const {
        return chart_height - margin_bottom - value / high * (chart_height - margin_top - margin_bottom);
    }
};

std::string svg_opening(const std::string& title, const std::string& description) {
    return fmt::format("<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\"><desc>{}</desc>\n",
                       chart_width, chart_height, html(title), html(description));
}

std::string grid_lines(const SvgScale& scale) {
    std::string text;
    for (double value = 0; value <= scale.high * 1.0001; value += scale.step) {
        text += fmt::format(
            "<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text class=\"tick\" x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.4g}</text>\n",
            margin_left, chart_width - margin_right, scale.y(value), margin_left - 7, scale.y(value) + 4, value);
    }
    return text;
}

std::string symbol_at(double x, double y, std::size_t group) {
    const std::size_t k = group % svg_groups;
    switch (k % 3) {
        case 0: return fmt::format("<circle class=\"g{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\">", k, x, y);
        case 1:
            return fmt::format("<path class=\"g{}\" d=\"M{:.1f} {:.1f}l5.2 5.2l-5.2 5.2l-5.2 -5.2z\">", k, x, y - 5.2);
        default:
            return fmt::format("<rect class=\"g{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"7.4\" height=\"7.4\">", k,
                               x - 3.7, y - 3.7);
    }
}

std::string closing_of(std::size_t group) {
    constexpr const char* names[] = {"</circle>", "</path>", "</rect>"};
    return names[group % svg_groups % 3];
}

std::string days_of(const SvgTrend& trend, double per_point) {
    constexpr double label = 74;
    std::string text;
    std::string day;
    double end = 0;
    for (std::size_t i = 0; i < trend.points.size(); ++i) {
        const double x = margin_left + (static_cast<double>(i) + 0.5) * per_point;
        if (trend.points[i].day == day || x < end || x + label > chart_width) continue;
        day = trend.points[i].day;
        end = x + label + 12;
        text += fmt::format(
            "<line class=\"axis\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick\" x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
            x, chart_height - margin_bottom, chart_height - margin_bottom + 6, chart_height - margin_bottom + 20,
            html(day));
    }
    return text;
}

}  // namespace

std::string svg_symbol(std::size_t group) {
    return "<svg class=\"key\" viewBox=\"0 0 14 14\" aria-hidden=\"true\">" + symbol_at(7, 7, group) +
           closing_of(group) + "</svg>";
}

std::string svg_trend(const SvgTrend& trend) {
    double most = 0;
    for (const SvgPoint& point : trend.points) {
        if (std::isfinite(point.value)) most = std::max(most, point.value);
    }
    const SvgScale scale(most, trend.counts);
    const double per_point =
        (chart_width - margin_left - margin_right) / static_cast<double>(std::max<std::size_t>(1, trend.points.size()));
    std::string text = svg_opening(trend.title, trend.description) + grid_lines(scale) + days_of(trend, per_point);
    if (trend.change) {
        const double x = margin_left + static_cast<double>(*trend.change) * per_point;
        text += fmt::format("<line class=\"change\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>\n", x,
                            margin_top, chart_height - margin_bottom);
        text += fmt::format(
            "<line class=\"level\" x1=\"{0}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><line class=\"level\" x1=\"{1:.1f}\" x2=\"{3}\" y1=\"{4:.1f}\" y2=\"{4:.1f}\"/>\n",
            margin_left, x, scale.y(trend.before), chart_width - margin_right, scale.y(trend.after));
    }
    for (std::size_t i = 0; i < trend.points.size(); ++i) {
        const SvgPoint& point = trend.points[i];
        if (!std::isfinite(point.value)) continue;
        text += symbol_at(margin_left + (static_cast<double>(i) + 0.5) * per_point, scale.y(point.value), point.group) +
                "<title>" + html(point.tip) + "</title>" + closing_of(point.group) + "\n";
    }
    return text + "</svg>\n";
}

std::string svg_pareto(const std::string& title, const std::vector<SvgBar>& bars) {
    double total = 0;
    std::string description;
    for (const SvgBar& bar : bars) {
        total += bar.value;
        description += fmt::format("{}{}: {:g}", description.empty() ? "" : ", ", bar.name, bar.value);
    }
    const SvgScale scale(bars.empty() ? 0 : bars.front().value, true);
    const double room =
        chart_width - margin_left - margin_right - 44;  // the axis of the cumulative share is at the right
    const double per_bar = room / static_cast<double>(std::max<std::size_t>(1, bars.size()));
    const auto y_of_share = [](double share) {
        return chart_height - margin_bottom - share * (chart_height - margin_top - margin_bottom);
    };
    std::string text = svg_opening(title, description) + grid_lines(scale);
    std::string line;
    std::string dots;
    double sum = 0;
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const double x = margin_left + (static_cast<double>(i) + 0.5) * per_bar;
        sum += bars[i].value;
        const double y = y_of_share(sum / total);
        text += fmt::format(
            "<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}: {:g}</title></rect>",
            x - 0.32 * per_bar, scale.y(bars[i].value), 0.64 * per_bar,
            chart_height - margin_bottom - scale.y(bars[i].value), html(bars[i].name), bars[i].value);
        text += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x,
                            chart_height - margin_bottom + 18, html(bars[i].name));
        line += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x, y);
        dots += fmt::format(
            "<circle class=\"share\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"><title>{:.0f} %</title></circle>", x, y,
            100 * sum / total);
    }
    for (const int percent : {0, 50, 100})
        text += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{:.1f}\">{} %</text>\n", chart_width - margin_right - 38,
                            y_of_share(percent / 100.0) + 4, percent);
    return text + "<path class=\"share\" d=\"" + line + "\"/>" + dots + "\n</svg>\n";
}

}  // namespace clsurf::io
