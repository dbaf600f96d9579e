#pragma once
// Constant-speed intervals as text, CSV and JSON.

#include <string>

#include "core/diagnostic.h"
#include "intervals/program_intervals.h"

namespace clsurf::io {

[[nodiscard]] std::string intervals_text(const ProgramIntervals& all);
/// One row per interval; the columns are the keys of the JSON.
[[nodiscard]] std::string intervals_csv(const ProgramIntervals& all);
/// Keys: intervals[]{pass, lines, length_mm, mean_curvature_per_mm, greatest_curvature_per_mm, feed_mm_min, own_speed_mm_min, speed_mm_min},
/// summary{passes, intervals, step_over_mm}, diagnostics[].
[[nodiscard]] std::string intervals_json(const ProgramIntervals& all, const Diagnostics& diagnostics);

}  // namespace clsurf::io
