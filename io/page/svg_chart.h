#pragma once
// Charts of a page as inline SVG. Their colours come from the style of the page, so that they follow light and dark; texts
// for screen readers are in <title> and <desc>. Used inside io only.

#include <optional>
#include <string>
#include <vector>

namespace clsurf::io {

struct SvgPoint {
    double value = 0;       ///< NaN: a gap
    std::string tip;        ///< shown under the mouse pointer
    std::string day;        ///< "2026-11-24", below the first point of a day if there is room
    std::size_t group = 0;  ///< determines colour and symbol
};

struct SvgTrend {
    std::string title, description;  ///< for screen readers
    std::vector<SvgPoint> points;
    bool counts = false;                ///< values are whole numbers
    std::optional<std::size_t> change;  ///< index of the first point after a change
    double before = 0, after = 0;       ///< medians before and after the change
};
/// Points in order, with one symbol each.
[[nodiscard]] std::string svg_trend(const SvgTrend& trend);

struct SvgBar {
    std::string name;
    double value = 0;
};
/// A Pareto chart: bars in falling order with their cumulative share. `bars` are in that order.
[[nodiscard]] std::string svg_pareto(const std::string& title, const std::vector<SvgBar>& bars);

constexpr std::size_t svg_groups = 6;  ///< number of colours; further groups reuse them
/// The symbol of a group, for a legend.
[[nodiscard]] std::string svg_symbol(std::size_t group);

}  // namespace clsurf::io
