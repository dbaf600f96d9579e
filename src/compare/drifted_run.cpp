#include "compare/drifted_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statistics.h"
#include "toolpath/arc_length.h"

namespace clsurf {
namespace {

constexpr double compared_places = 20'000;
constexpr double clear_lead = 2.0;  ///< ratio of the drifted run to the next one

/// The median of known values; NaN if there are fewer than three.
float median_of_known(std::vector<float>& values) {
    std::erase_if(values, [](float v) { return !(v == v); });
    if (values.size() < 3) return std::numeric_limits<float>::quiet_NaN();
    return midpoint_median(values);
}

}  // namespace

DriftFinder::DriftFinder(const ClSurface& surface) {
    const ArcLength arc_length(surface.positions);
    const PointIndex count = surface.positions.size();
    const double every = count > 0 ? arc_length.to(count - 1) / compared_places : 0;
    double since = every;
    for (PointIndex i = 0; i < count; ++i) {
        const double step = arc_length.step(i);
        since += step;
        if (since < every || !(step > 0)) continue;
        since = 0;
        places_.push_back(i);
    }
}

void DriftFinder::add(const RunDifferences& differences) {
    auto& run = runs_.emplace_back();
    for (std::size_t q = 0; q < run_quantities; ++q) {
        const Column<float>& values = differences.of[q];
        threshold_[q] = std::max<double>(threshold_[q], differences.threshold[q]);
        for (const PointIndex i : places_) {
            run[q].push_back(values.empty() ? std::numeric_limits<float>::quiet_NaN()
                                            : values[static_cast<std::size_t>(i)]);
        }
    }
}

std::vector<RunDeparture> DriftFinder::departures() const {
    if (runs_.size() < 2) return {};
    std::vector<RunDeparture> all(runs_.size() + 1);
    std::vector<float> here;
    for (std::size_t q = 0; q < run_quantities; ++q) {
        std::vector<double> squares(all.size(), 0);
        std::vector<double> known(all.size(), 0);
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const auto value_of = [&](std::size_t run) { return run == 0 ? 0.0F : runs_[run - 1][q][k]; };
            here.clear();
            for (std::size_t run = 0; run < all.size(); ++run) here.push_back(value_of(run));
            const float usual = median_of_known(here);
            if (!(usual == usual)) continue;
            for (std::size_t run = 0; run < all.size(); ++run) {
                const double departure = value_of(run) - usual;
                if (!(departure == departure)) continue;
                squares[run] += departure * departure;
                known[run] += 1;
            }
        }
        for (std::size_t run = 0; run < all.size(); ++run) {
            all[run].rms[q] = std::sqrt(squares[run] / known[run]);  // 0/0: not known
            const double score = all[run].rms[q] / threshold_[q];
            if (!(score > all[run].score)) continue;
            all[run].score = score;
            all[run].quantity = static_cast<RunQuantity>(q);
        }
    }
    return all;
}

std::optional<std::size_t> drifted_run(const std::vector<RunDeparture>& departures) {
    if (departures.size() < 3) return std::nullopt;
    std::size_t worst = 0;
    for (std::size_t run = 1; run < departures.size(); ++run) {
        if (departures[run].score > departures[worst].score) worst = run;
    }
    double next = 0;
    for (std::size_t run = 0; run < departures.size(); ++run) {
        if (run != worst) next = std::max(next, departures[run].score);
    }
    if (departures[worst].score < 1 || departures[worst].score < clear_lead * next) return std::nullopt;
    return worst;
}

}  // namespace clsurf
