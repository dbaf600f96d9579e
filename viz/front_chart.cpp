#include "viz/front_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "viz/chart_frame.h"
#include "viz/label_placer.h"
#include "viz/symbol.h"

namespace clsurf::viz {
namespace {

// Safe for colour-blind readers (Okabe, Ito 2008); the shapes are also distinct in print.
constexpr Rgb front_colour{0, 90, 178};
constexpr Rgb chosen_colour{213, 94, 0};
constexpr Rgb dominated_colour{170, 170, 176};
constexpr Rgb step_colour{150, 185, 220};

class FrontDrawer {
public:
    FrontDrawer(const FrontPicture& picture, const ChartLook& look)
        : picture_(picture), look_(look), text_(text_size_of(look, 44)), sheet_(sheet_of(look)) {}

    Image drawn() {
        add_titles();
        const double left = 6.5 * text_, right = 2 * text_, below = 5 * text_, above = 7 * text_, between = 3 * text_;
        const double width = look_.width - left - right;
        const double height = 0.5 * (look_.height - below - above - between);
        add_panel({left, below + height + between, width, height}, &FrontSymbol::mismatch,
                  "Speed difference to the adjacent passes, 95th percentile [mm/min]", false);
        add_panel({left, below, width, height}, &FrontSymbol::jerk, "Jerk, 95th percentile [mm/s³]", true);
        return draw(sheet_, look_.gl, look_.supersample);
    }

private:
    void text(double x, double y, const std::string& words, double size, Align align, bool bold, const Rgb& rgb) {
        sheet_.texts.push_back({x, y, words, size, align, bold, rgb});
    }

    void add_titles() {
        const double room = look_.width - 2 * text_;
        sheet_.texts.push_back(
            fitted({text_, look_.height - 1.5 * text_, look_.title, 1.4 * text_, Align::left, true, chart_ink}, room));
        sheet_.texts.push_back(
            fitted({text_, look_.height - 3.2 * text_, look_.subtitle, text_, Align::left, false, chart_faint}, room));
        text(look_.width - 2 * text_, 2.6 * text_, look_.x_label, text_, Align::right, true, chart_ink);
        add_legend(0.9 * text_);
    }

    /// Adds a legend in a separate line, left-aligned.
    void add_legend(double y) {
        double x = 1.5 * text_;
        const auto entry = [&](SymbolShape shape, const Rgb& rgb, const std::string& words) {
            add_symbol(sheet_, {x, y}, shape, 0.36 * text_, rgb);
            text(x + 0.8 * text_, y, words, 0.85 * text_, Align::left, false, chart_ink);
            x += 2.6 * text_ + text_width({0, 0, words, 0.85 * text_, Align::left, false, chart_ink});
        };
        entry(SymbolShape::disc, front_colour, "on the front");
        entry(SymbolShape::disc, dominated_colour, "another one is better");
        entry(SymbolShape::square, chart_ink, picture_.reference);
        if (picture_.chosen) entry(SymbolShape::diamond, chosen_colour, "chosen");
        sheet_.lines.push_back({{{x - 0.5 * text_, y}, {x + 1.1 * text_, y}}, 0.14 * text_, step_colour, Level::line});
        text(x + 1.6 * text_, y, "least in that time", 0.85 * text_, Align::left, false, chart_ink);
    }

    [[nodiscard]] ChartFrame frame_of(const Rect& rect, double FrontSymbol::*value) const {
        ChartFrame frame;
        frame.rect = rect;
        const auto times = std::ranges::minmax(picture_.rows, {}, &FrontSymbol::time);
        const double span = std::max(times.max.time - times.min.time, 1e-3 * times.max.time);
        frame.x_low = times.min.time - 0.04 * span;
        frame.x_high = times.min.time + 1.06 * span;
        frame.y_low = 0;
        frame.y_high = 1.12 * std::ranges::max(picture_.rows, {}, value).*value;
        if (!(frame.y_high > 0)) frame.y_high = 1;
        return frame;
    }

    void add_panel(const Rect& rect, double FrontSymbol::*value, const std::string& label, bool x_labels) {
        const ChartFrame frame = frame_of(rect, value);
        add_grid(sheet_, frame, text_, x_labels);
        text(rect.x, rect.y + rect.height + 1.0 * text_, label, text_, Align::left, true, chart_ink);
        const double radius = 0.36 * text_;
        LabelPlacer labels(rect);
        numbers_.clear();
        add_steps(frame, value, labels);
        const auto place = [&](std::size_t k) { return frame.at(picture_.rows[k].time, picture_.rows[k].*value); };
        for (std::size_t k = 0; k < picture_.rows.size(); ++k) {
            const Vec2 at = place(k);
            labels.take({at.x() - radius, at.y() - radius, 2 * radius, 2 * radius});
        }
        for (const std::size_t k : drawing_order()) {
            const bool is_chosen = picture_.chosen == k;
            const SymbolShape shape = is_chosen ? SymbolShape::diamond
                                      : k == 0  ? SymbolShape::square
                                                : SymbolShape::disc;
            const Rgb& rgb = is_chosen                   ? chosen_colour
                             : k == 0                    ? chart_ink
                             : picture_.rows[k].on_front ? front_colour
                                                         : dominated_colour;
            add_symbol(sheet_, place(k), shape, (is_chosen ? 1.4 : 1.0) * radius, rgb,
                       picture_.rows[k].on_front || k == 0 || is_chosen ? Level::dot_fill : Level::dot);
        }
        // The most important numbers get the closest places.
        std::vector<std::size_t> order = drawing_order();
        std::ranges::reverse(order);
        for (const std::size_t k : order) {
            if (picture_.rows[k].on_front || k == 0 || picture_.chosen == k) add_number(labels, k, place(k), radius);
        }
    }

    /// From bottom to top: other rows, the front, the reference, the chosen row.
    [[nodiscard]] std::vector<std::size_t> drawing_order() const {
        std::vector<std::size_t> order(picture_.rows.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto rank = [&](std::size_t k) {
            if (picture_.chosen == k) return 3;
            if (k == 0) return 2;
            return picture_.rows[k].on_front ? 1 : 0;
        };
        std::ranges::stable_sort(order, {}, rank);
        return order;
    }

    void add_number(LabelPlacer& labels, std::size_t k, const Vec2& at, double radius) {
        const double size = 0.85 * text_;
        const bool strong = k == 0 || picture_.chosen == k;
        FlatText number{0,
                        0,
                        fmt::format("{}", k + 1),
                        size,
                        Align::centre,
                        strong,
                        picture_.chosen == k ? chosen_colour : chart_ink};
        const Vec2 room(text_width(number) + 0.3 * text_, 1.05 * size);
        const Vec2 wanted = at + Vec2(0, radius + 0.6 * room.y());
        const std::optional<Rect> free = labels.place(wanted, room);
        if (!free) return;  // the number is in the table
        number.x = free->x + 0.5 * free->width;
        number.y = free->y + 0.5 * free->height;
        const Vec2 middle(number.x, number.y);
        if ((middle - wanted).norm() > 0.9 * size) {
            const Vec2 toward = (at - middle).normalized(), from = middle + 0.55 * size * toward;
            if (crosses_number(from, at)) return;
            sheet_.lines.push_back({{from, at - radius * toward}, 1, chart_faint, Level::edge});
        }
        labels.take(*free);
        numbers_.push_back(*free);
        sheet_.texts.push_back(std::move(number));
    }

    [[nodiscard]] bool crosses_number(const Vec2& from, const Vec2& to) const {
        constexpr int steps = 20;
        for (int k = 0; k <= steps; ++k) {
            const Vec2 p = from + (to - from) * k / steps;
            if (std::ranges::any_of(numbers_, [&](const Rect& r) {
                    return p.x() >= r.x && p.x() <= r.x + r.width && p.y() >= r.y && p.y() <= r.y + r.height;
                }))
                return true;
        }
        return false;
    }

    /// The lowest value of all rows up to each time.
    void add_steps(const ChartFrame& frame, double FrontSymbol::*value, LabelPlacer& labels) {
        std::vector<std::size_t> order(picture_.rows.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t k) { return picture_.rows[k].time; });
        FlatLine line{{}, 0.14 * text_, step_colour, Level::mark};
        double least = std::numeric_limits<double>::infinity();
        for (const std::size_t k : order) {
            const FrontSymbol& row = picture_.rows[k];
            if (!(row.*value < least)) continue;
            if (!line.points.empty()) line.points.push_back(frame.at(row.time, least));
            least = row.*value;
            line.points.push_back(frame.at(row.time, least));
        }
        if (line.points.empty()) return;
        line.points.push_back(frame.at(frame.x_high, least));
        for (std::size_t k = 1; k < line.points.size(); ++k) {
            const Vec2 low = line.points[k - 1].cwiseMin(line.points[k]),
                       high = line.points[k - 1].cwiseMax(line.points[k]);
            labels.take({low.x(), low.y(), high.x() - low.x(), high.y() - low.y()});
        }
        sheet_.lines.push_back(std::move(line));
    }

    const FrontPicture& picture_;
    const ChartLook& look_;
    double text_;
    Sheet sheet_;
    std::vector<Rect> numbers_;  ///< rectangles of the numbers on the present panel
};

}  // namespace

Image draw_front(const FrontPicture& picture, const ChartLook& look) { return FrontDrawer(picture, look).drawn(); }

}  // namespace clsurf::viz
