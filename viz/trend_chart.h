#pragma once
// A quantity over consecutive runs, one symbol each, with the medians before and after a change.

#include <optional>
#include <string>
#include <vector>

#include "viz/chart.h"

namespace clsurf::viz {

struct TrendSymbol {
    double value = 0;       ///< NaN: a gap
    std::string run;        ///< label below it, "12"
    std::string day;        ///< and below that, "2026-11-24"
    std::size_t group = 0;  ///< index of its group
};

struct TrendLevels {
    std::size_t first = 0;  ///< index of the first run after the change
    double before = 0, after = 0;
    std::string label;  ///< "since run 12"
};

struct TrendPicture {
    std::vector<TrendSymbol> symbols;
    std::vector<std::string> groups;  ///< names, each with its own colour and symbol; one empty name: no legend
    std::string y_label;
    std::optional<double> limit;  ///< a horizontal line
    std::optional<TrendLevels> levels;
};

/// Throws SystemError.
[[nodiscard]] Image draw_trend(const TrendPicture& picture, const ChartLook& look);

}  // namespace clsurf::viz
