#pragma once
// Charts of a page as SVG inside it: colours are those of the page's style, so that they follow light and dark; words for
// screen readers stand in <title> and <desc>. Used inside io only.

#include <optional>
#include <string>
#include <vector>

namespace clsurf::io {

struct SvgPoint {
    double value = 0;       ///< NaN: a gap
    std::string tip;        ///< shown where the mouse rests
    std::string day;        ///< "2026-11-24", below the first point of a day where there is room
    std::size_t group = 0;  ///< its colour and shape
};

struct SvgTrend {
    std::string title, description;  ///< for screen readers
    std::vector<SvgPoint> points;
    bool counts = false;                ///< values are whole numbers
    std::optional<std::size_t> change;  ///< index of the first point of a new level
    double before = 0, after = 0;       ///< medians beside it
};
/// Points in their order, a symbol each.
[[nodiscard]] std::string svg_trend(const SvgTrend& trend);

struct SvgBar {
    std::string name;
    double value = 0;
};
/// A Pareto chart: bars in falling order with their cumulative share. `bars` are in that order.
[[nodiscard]] std::string svg_pareto(const std::string& title, const std::vector<SvgBar>& bars);

constexpr std::size_t svg_groups = 6;  ///< colours; groups beyond share them
/// The symbol of a group alone, for a legend.
[[nodiscard]] std::string svg_symbol(std::size_t group);

}  // namespace clsurf::io
