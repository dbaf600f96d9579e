#include "measured/measured_result.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/units.h"

namespace clsurf {
namespace {

constexpr double least_correlation = 0.3;
// As in docs/howto/measured.md#the-pose, the last message.
constexpr double most_times = 3;        ///< largest ratio of measured and predicted Rq if they are alike
constexpr double least_rough = 0.0002;  ///< [mm] Rq of the rougher one; heights are not known more precisely

}  // namespace

std::optional<std::string> doubt_of(const MeasuredComparison& c) {
    if (!c.reason.empty() || std::max(c.measured.rq, c.predicted.rq) < least_rough) return std::nullopt;
    const bool alike = c.measured.rq <= most_times * c.predicted.rq && c.predicted.rq <= most_times * c.measured.rq;
    // Effects that are not predicted add to the measured roughness. The more they add, the lower the correlation is.
    const double expected = alike ? std::min(1.0, c.predicted.rq / c.measured.rq) : 1.0;
    if (c.correlation >= least_correlation * expected) return std::nullopt;
    return fmt::format(
        "its roughness differs from that of the place where it fits best (correlation {:.3f}, Ra {:.3f} µm measured, {:.3f} µm "
        "predicted): the start or its angle is wrong, or another part was measured",
        c.correlation, c.measured.ra * um_per_mm, c.predicted.ra * um_per_mm);
}

MeasuredResult align_by_roughness(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                  const Signals& signals, const AlignRules& rules) {
    MeasuredResult result;
    result.alignment = align(data, as_machined, rules);
    if (result.alignment.determined()) {
        const AlignedHeights heights(data, result.alignment.pose);
        result.comparison = compare_roughness(data, heights, as_machined, signals);
        if (std::optional<std::string> doubt = doubt_of(result.comparison))
            result.alignment.reasons.push_back(std::move(*doubt));
    }
    if (!result.alignment.determined()) {
        result.comparison = {};
        result.comparison.reason = "the pose of the measurement is not determined";
    }
    return result;
}

MeasuredResult compare_with_measured(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                     const Signals& signals, const QualityReport& report, const AlignRules& rules) {
    MeasuredResult result = align_by_roughness(data, as_machined, signals, rules);
    if (!result.alignment.determined()) return result;
    const AlignedHeights heights(data, result.alignment.pose);
    result.marks = compare_marks(data, heights, as_machined, signals, report, result.comparison.noise);
    return result;
}

}  // namespace clsurf
