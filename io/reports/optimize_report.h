#pragma once
// The result of the optimiser and its evaluation, as text and JSON.

#include <string>

#include "core/diagnostic.h"
#include "repair/optimizer.h"

namespace clsurf::io {

[[nodiscard]] std::string optimize_text(const Optimized& result);
/// Keys: accepted, reason, deviation_mm, time_before_s, time_after_s, mismatch_before, mismatch_after [mm/min],
/// defects_before, defects_after, intervals, splines (of these), lines_before, lines_after, lines_changed, proof
/// ("simulation"), log (of a recorded run: points, time_s, mismatch, defects, motions_in_need; otherwise null), diagnostics,
/// defects_by_quantity (name: [before, after]); if accepted, defects_left: those of the new program with the keys of `check`;
/// of a program on five axes, tool_axis_deviation_deg.
[[nodiscard]] std::string optimize_json(const Optimized& result, const Diagnostics& diagnostics);

}  // namespace clsurf::io
