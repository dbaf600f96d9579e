#pragma once
// MeasuredResult: what a measurement says about the prediction: its pose, the roughness of both, the marks.

#include "measured/align.h"
#include "measured/compare_measured.h"
#include "measured/compared_marks.h"

namespace clsurf {

struct MeasuredResult {
    Alignment alignment;
    MeasuredComparison comparison;    ///< empty with a reason where the pose is not determined
    std::vector<ComparedMark> marks;  ///< that the measurement crosses
};

/// Aligns and compares. `as_machined` has a step-over; `signals` are its own, `report` has its defects. Throws UsageError as
/// align() does. Parallel.
[[nodiscard]] MeasuredResult compare_with_measured(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                                   const Signals& signals, const QualityReport& report,
                                                   const AlignRules& rules = {});

}  // namespace clsurf
