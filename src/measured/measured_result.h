#pragma once
// MeasuredResult: the comparison of a measurement with the prediction: its pose, the roughness of both, the marks.

#include <optional>
#include <string>

#include "measured/align.h"
#include "measured/compare_measured.h"
#include "measured/compared_marks.h"

namespace clsurf {

struct MeasuredResult {
    Alignment alignment;
    MeasuredComparison comparison;    ///< empty with a reason if the pose is not determined
    std::vector<ComparedMark> marks;  ///< marks that the measurement crosses
};

/// Why the place of a measurement is doubtful after the comparison: its roughness differs from the roughness of the surface
/// there. nullopt: it does not, or both are too smooth for a decision.
[[nodiscard]] std::optional<std::string> doubt_of(const MeasuredComparison& comparison);

/// Aligns and compares the roughness, without marks. The pose counts as not determined if the roughness of both does not match.
/// `as_machined` must have a step-over; `signals` are its own. Throws UsageError as align() does. Parallel.
[[nodiscard]] MeasuredResult align_by_roughness(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                                const Signals& signals, const AlignRules& rules = {});

/// The same with the marks: `report` contains the defects of `as_machined`.
[[nodiscard]] MeasuredResult compare_with_measured(const MeasuredData& data, const AsMachinedSurface& as_machined,
                                                   const Signals& signals, const QualityReport& report,
                                                   const AlignRules& rules = {});

}  // namespace clsurf
