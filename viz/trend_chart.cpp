#include "viz/trend_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viz/chart_frame.h"
#include "viz/symbol.h"

namespace clsurf::viz {
namespace {

constexpr Rgb limit_colour{200, 30, 30};
constexpr Rgb level_colour{120, 120, 126};
// Safe for colour-blind readers (Okabe, Ito 2008); the shapes are also distinct in print.
constexpr Rgb group_colours[] = {{0, 90, 178}, {213, 94, 0}, {0, 130, 95}, {160, 70, 130}, {110, 85, 0}, {70, 70, 75}};
constexpr std::size_t trend_shapes = 4;
constexpr double below_symbols =
    1.25;  ///< text sizes from the axis to the run numbers: a symbol at 0 extends below the axis

class TrendDrawer {
public:
    TrendDrawer(const TrendPicture& picture, const ChartLook& look)
        : picture_(picture), look_(look), text_(text_size_of(look, 40)), sheet_(sheet_of(look)) {
        const double legend = picture.groups.size() > 1 || !picture.groups.front().empty() ? legend_width() : 0;
        frame_.rect = {6.5 * text_, 6.0 * text_, look.width - 8.5 * text_ - legend, look.height - 12.0 * text_};
        frame_.x_low = -0.5;
        frame_.x_high = static_cast<double>(picture.symbols.size()) - 0.5;
        fit();
        if (legend > 0) add_legend();
    }

    Image drawn() {
        add_texts();
        add_y_axis(sheet_, frame_, text_);
        add_runs();
        if (picture_.levels) add_levels(*picture_.levels);
        if (picture_.limit) add_across(*picture_.limit, frame_.x_low, frame_.x_high, limit_colour, 0.12 * text_);
        const double per_run = frame_.rect.width / std::max<std::size_t>(1, picture_.symbols.size());
        const double radius =
            text_ * std::clamp(0.5 * per_run / text_, 0.2, 0.42);  // many symbols must not hide each other
        for (std::size_t i = 0; i < picture_.symbols.size(); ++i) {
            const TrendSymbol& s = picture_.symbols[i];
            if (std::isfinite(s.value)) add_symbol(frame_.at(static_cast<double>(i), s.value), s.group, radius);
        }
        return draw(sheet_, look_.gl, look_.supersample);
    }

private:
    void text(double x, double y, const std::string& words, double size, Align align, bool bold, const Rgb& rgb) {
        sheet_.texts.push_back({x, y, words, size, align, bold, rgb});
    }

    double legend_width() const {
        double widest = 0;
        for (const std::string& name : picture_.groups)
            widest = std::max(widest, text_width({0, 0, name, text_, Align::left, false, chart_ink}));
        return std::min(widest, 0.25 * look_.width) + 3 * text_;
    }

    void fit() {
        double low = 0;
        double high = -std::numeric_limits<double>::infinity();
        for (const TrendSymbol& s : picture_.symbols) {
            if (!std::isfinite(s.value)) continue;
            low = std::min(low, s.value);
            high = std::max(high, s.value);
        }
        if (picture_.limit) high = std::max(high, *picture_.limit);
        if (!(high > low)) high = low + 1;
        frame_.y_low = low < 0 ? low - 0.06 * (high - low) : 0;
        frame_.y_high = high + 0.08 * (high - low);
    }

    void add_texts() {
        const Rect& r = frame_.rect;
        const double room = look_.width - 2 * text_;
        sheet_.texts.push_back(
            fitted({text_, look_.height - 1.5 * text_, look_.title, 1.4 * text_, Align::left, true, chart_ink}, room));
        sheet_.texts.push_back(
            fitted({text_, look_.height - 3.2 * text_, look_.subtitle, text_, Align::left, false, chart_faint}, room));
        text(r.x, r.y + r.height + 1.1 * text_, picture_.y_label, text_, Align::left, true, chart_ink);
        text(r.x + r.width, r.y - 3.6 * text_, look_.x_label, text_, Align::right, true, chart_ink);
        sheet_.texts.push_back(
            fitted({text_, 0.9 * text_, look_.footnote, 0.85 * text_, Align::left, false, chart_faint}, room));
    }

    /// Run numbers as dense as readable, and the day if it changes.
    void add_runs() {
        const double per_run = frame_.rect.width / std::max<std::size_t>(1, picture_.symbols.size());
        double number_end = -std::numeric_limits<double>::infinity();
        double day_end = number_end;
        std::string day;
        for (std::size_t i = 0; i < picture_.symbols.size(); ++i) {
            const TrendSymbol& s = picture_.symbols[i];
            const double x = frame_.rect.x + (static_cast<double>(i) + 0.5) * per_run;
            const double half = 0.5 * text_width({0, 0, s.run, text_, Align::centre, false, chart_ink});
            if (x - half > number_end + 0.6 * text_) {
                text(x, frame_.rect.y - below_symbols * text_, s.run, text_, Align::centre, false, chart_ink);
                number_end = x + half;
            }
            const double width = text_width({0, 0, s.day, 0.85 * text_, Align::left, false, chart_faint});
            if (s.day == day || x < day_end + 0.8 * text_ || x + width > frame_.rect.x + frame_.rect.width) continue;
            day = s.day;
            text(x, frame_.rect.y - (below_symbols + 1.25) * text_, s.day, 0.85 * text_, Align::left, false,
                 chart_faint);
            sheet_.lines.push_back(
                {{{x, frame_.rect.y}, {x, frame_.rect.y - 0.3 * text_}}, 1, level_colour, Level::edge});
            day_end = x + width;
        }
    }

    void add_across(double value, double from, double to, const Rgb& rgb, double width) {
        sheet_.lines.push_back({{frame_.at(from, value), frame_.at(to, value)}, width, rgb, Level::line});
    }

    void add_levels(const TrendLevels& levels) {
        const double at = static_cast<double>(levels.first) - 0.5;
        add_across(levels.before, frame_.x_low, at, level_colour, 0.12 * text_);
        add_across(levels.after, at, frame_.x_high, level_colour, 0.12 * text_);
        const Vec2 p = frame_.at(at, frame_.y_high);
        sheet_.lines.push_back({{frame_.at(at, frame_.y_low), p}, 1.4, limit_colour, Level::line});
        FlatText note{p.x(), p.y() + 1.1 * text_, levels.label, text_, Align::left, true, limit_colour};
        const double label_end =
            frame_.rect.x + 1.5 * text_ + text_width({0, 0, picture_.y_label, text_, Align::left, true, chart_ink});
        note.x = std::max(label_end, std::min(note.x, frame_.rect.x + frame_.rect.width - text_width(note)));
        sheet_.texts.push_back(std::move(note));
    }

    void add_legend() {
        const double x = frame_.rect.x + frame_.rect.width + 1.6 * text_;
        double y = frame_.rect.y + frame_.rect.height - 0.8 * text_;
        for (std::size_t k = 0; k < picture_.groups.size() && y > frame_.rect.y; ++k, y -= 1.6 * text_) {
            add_symbol({x, y}, k, 0.42 * text_);
            const std::string name = picture_.groups[k].empty() ? "not given" : picture_.groups[k];
            sheet_.texts.push_back(
                fitted({x + text_, y, name, text_, Align::left, false, chart_ink}, look_.width - x - 1.5 * text_));
        }
    }

    void add_symbol(const Vec2& at, std::size_t group, double r) {
        viz::add_symbol(sheet_, at, static_cast<SymbolShape>(group % trend_shapes), r,
                        group_colours[group % std::size(group_colours)]);
    }

    const TrendPicture& picture_;
    const ChartLook& look_;
    double text_;
    Sheet sheet_;
    ChartFrame frame_;
};

}  // namespace

Image draw_trend(const TrendPicture& picture, const ChartLook& look) { return TrendDrawer(picture, look).drawn(); }

}  // namespace clsurf::viz
