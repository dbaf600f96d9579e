#include "measured/measured_result.h"

namespace clsurf {

MeasuredResult compare_with_measured(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                     const Signals& signals, const QualityReport& report, const AlignRules& rules) {
    MeasuredResult result;
    result.alignment = align(data, as_machined, rules);
    if (!result.alignment.determined()) {
        result.comparison.reason = "the pose of the measurement is not determined";
        return result;
    }
    const AlignedHeights heights(data, result.alignment.pose);
    result.comparison = compare_roughness(data, heights, as_machined, signals);
    result.marks = compare_marks(data, heights, as_machined, signals, report, result.comparison.noise);
    return result;
}

}  // namespace clsurf
