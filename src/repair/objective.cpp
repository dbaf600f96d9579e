#include "repair/objective.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"

namespace clsurf {
namespace {

// The weights of docs/optimize.md#the-objective; half of the mismatch is the goal of docs/optimize.md#results.
constexpr double growth_weight = 0.03;    ///< weight of a program's growth relative to shares of mismatch and defects
constexpr double goal_of_mismatch = 0.5;  ///< remaining share, below which …
constexpr double beyond_goal = 0.1;       ///< … less mismatch counts less

/// The mismatch of a run, at least the least one that counts.
double counted(const RunMeasures& run, const RunMeasures& before) {
    return std::max(objective_mismatch(before, run), least_mismatch * before.speed);
}

}  // namespace

double objective(const RunMeasures& before, const RunMeasures& after, double line_ratio, double more_time) {
    const double was = counted(before, before), is = counted(after, before);
    const double mismatch = was > 0 ? is / was : (is > 0 ? 2.0 : 1.0);
    const double defects = after.defects / std::max(1.0, before.defects);
    const double later = std::clamp(after.duration / before.duration - 1, 0.0, more_time);
    const bool rough = before.roughness > 0 && std::isfinite(after.roughness);
    const double roughness = rough ? after.roughness / before.roughness : 0;
    return growth_weight * line_ratio + roughness + std::max(mismatch, goal_of_mismatch) +
           beyond_goal * std::min(mismatch, goal_of_mismatch) + defects + later;
}

double gain_of(const RunMeasures& before, const RunMeasures& after, double line_ratio, double more_time) {
    return 1 - objective(before, after, line_ratio, more_time) / objective(before, before, 1, more_time);
}

std::string too_little_gain(std::string_view what, double gain) {
    if (gain >= least_gain) return {};
    return fmt::format("{} is {} %, less than {:.0f} %", what, fixed_text(100 * gain, 1), 100 * least_gain);
}

std::string why_not_better(const RunMeasures& before, const RunMeasures& after, double more_time) {
    const double was = objective_mismatch(before, before), is = objective_mismatch(before, after);
    if (!(is < was) && is > least_mismatch * before.speed)
        return fmt::format("the speeds of adjacent passes would differ by {:.0f} instead of {:.0f} mm/min",
                           is * seconds_per_minute, was * seconds_per_minute);
    if (after.defects > before.defects)
        return fmt::format("there would be {:.3g} defects instead of {:.3g}", after.defects, before.defects);
    const double longest = before.duration * (1 + more_time);
    if (after.duration > longest)
        return fmt::format("it would take {:.3f} instead of {:.3f} s", after.duration, longest);
    if (after.roughness > before.roughness * (1 + roughness_agrees))
        return fmt::format("the as-machined surface would be rougher: Ra {:.2f} instead of {:.2f} µm",
                           after.roughness * um_per_mm, before.roughness * um_per_mm);
    return {};
}

RunMeasures with_roughness(RunMeasures measures, const PartRoughness& roughness) {
    if (!roughness.patches.empty()) measures.roughness = roughness.ra;
    return measures;
}

}  // namespace clsurf
