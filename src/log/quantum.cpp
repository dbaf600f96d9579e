#include "log/quantum.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clsurf {
namespace {

constexpr double least_quantum = 5e-6;  ///< [mm] or [deg]; finer steps are rounding of the file
constexpr double least_change = 1e-9;   ///< rounding of doubles is no change
constexpr PointIndex looked_at = 20'000;

}  // namespace

double quantum_of(const ChannelView& channel) {
    std::vector<double> steps;
    const auto n = static_cast<std::size_t>(std::min(channel.count, looked_at));
    std::vector<double> values(n);
    copy_block(channel, (channel.count - static_cast<PointIndex>(n)) / 2, values);
    // Differences of differences: at constant speed the way of a period is no grid.
    for (std::size_t i = 2; i < n; ++i) {
        const double step = std::abs(values[i] - 2 * values[i - 1] + values[i - 2]);
        if (step > least_change && std::isfinite(step)) steps.push_back(step);
    }
    if (steps.size() < 100) return 0;
    std::sort(steps.begin(), steps.end());
    const double candidate = steps[steps.size() / 100];
    // A grid: nearly all steps are whole multiples of the smallest one.
    const double smallest = steps.front();
    std::size_t on_grid = 0;
    for (const double step : steps) {
        const double ratio = step / smallest;
        if (std::abs(ratio - std::round(ratio)) < 0.02) ++on_grid;
    }
    const bool grid = candidate < 50 * smallest && on_grid > steps.size() * 98 / 100 && smallest > least_quantum;
    return grid ? smallest : 0;
}

}  // namespace clsurf
