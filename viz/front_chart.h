#pragma once
// A Pareto front: runs of a part by time and mismatch above, by time and jerk below.

#include <optional>
#include <string>
#include <vector>

#include "viz/chart.h"

namespace clsurf::viz {

struct FrontSymbol {
    double time = 0;      ///< [s]
    double mismatch = 0;  ///< [mm/min]
    double jerk = 0;      ///< [mm/s³]
    bool on_front = false;
};

/// Symbols are numbered like their rows, from 1. The first row is the reference.
struct FrontPicture {
    std::vector<FrontSymbol> rows;
    std::optional<std::size_t> chosen;
    std::string reference;  ///< "as the machine file"
};

/// Throws SystemError.
[[nodiscard]] Image draw_front(const FrontPicture& picture, const ChartLook& look);

}  // namespace clsurf::viz
