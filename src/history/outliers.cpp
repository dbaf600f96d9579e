#include "history/outliers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr double mad_of_sigma = 0.6745;  ///< as in the published score; 1 / deviation_of_mad differs in the fifth digit
constexpr double sigma_of_mean_deviation = 1.253314;  ///< √(π/2), of a normal distribution

/// The runs of each program, by its content.
std::map<std::string, std::vector<std::size_t>> by_program(std::span<const RunRecord> runs) {
    std::map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].judged) groups[runs[i].program_sha256].push_back(i);
    }
    return groups;
}

}  // namespace

std::vector<double> modified_z_scores(std::span<const double> values, double least_deviation) {
    std::vector<double> known;
    std::ranges::copy_if(values, std::back_inserter(known), [](double v) { return std::isfinite(v); });
    if (known.empty()) return {};
    const double middle =
        midpoint_median(std::vector(known));  // the order is kept: it affects the rounding of the mean
    double mean = 0;
    for (double& value : known) {
        value = std::abs(value - middle);
        mean += value / static_cast<double>(known.size());
    }
    const double mad = midpoint_median(known);
    if (!(mean > 0)) return {};
    const double sigma = std::max(mad > 0 ? mad / mad_of_sigma : sigma_of_mean_deviation * mean, least_deviation);
    std::vector<double> scores;
    for (const double value : values) scores.push_back((value - middle) / sigma);
    return scores;
}

std::vector<RunOutlier> find_outliers(std::span<const RunRecord> runs) {
    std::vector<RunOutlier> outliers;
    for (const auto& [program, members] : by_program(runs)) {
        if (members.size() < least_runs_for_outliers) continue;
        for (const HistoryQuantity& quantity : history_quantities()) {
            std::vector<double> values;
            for (const std::size_t i : members) values.push_back(quantity.of_run(runs[i]));
            const std::vector<double> scores = modified_z_scores(values, quantity.least_deviation);
            for (std::size_t k = 0; k < scores.size(); ++k) {
                if (!(std::abs(scores[k]) > outlier_score)) continue;
                std::vector<double> known;
                std::ranges::copy_if(values, std::back_inserter(known), [](double v) { return std::isfinite(v); });
                outliers.push_back({members[k], &quantity, values[k], midpoint_median(known), scores[k]});
            }
        }
    }
    std::ranges::stable_sort(outliers, std::ranges::greater{}, [](const RunOutlier& o) { return std::abs(o.z); });
    return outliers;
}

}  // namespace clsurf
