#pragma once
// MeasuredResult: what a measurement says about the prediction: its pose, the roughness of both, the marks.

#include <optional>
#include <string>

#include "measured/align.h"
#include "measured/compare_measured.h"
#include "measured/compared_marks.h"

namespace clsurf {

struct MeasuredResult {
    Alignment alignment;
    MeasuredComparison comparison;    ///< empty with a reason where the pose is not determined
    std::vector<ComparedMark> marks;  ///< that the measurement crosses
};

/// Why the place of a measurement is in doubt after the comparison: its roughness is not that of the surface there. Nothing: it
/// is, or both are too smooth to tell.
[[nodiscard]] std::optional<std::string> doubt_of(const MeasuredComparison& comparison);

/// Aligns and compares the roughness. Where the roughness of both shows that the pose is another one, it is not determined.
/// Without marks. `as_machined` has a step-over; `signals` are its own. Throws UsageError as align() does. Parallel.
[[nodiscard]] MeasuredResult align_by_roughness(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                                const Signals& signals, const AlignRules& rules = {});

/// The same with the marks: `report` has the defects of `as_machined`.
[[nodiscard]] MeasuredResult compare_with_measured(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                                   const Signals& signals, const QualityReport& report,
                                                   const AlignRules& rules = {});

}  // namespace clsurf
