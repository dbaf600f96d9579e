#pragma once
// A Pareto front of time against surface, as text, CSV and JSON.

#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic.h"
#include "tradeoff/front.h"
#include "tradeoff/plan_settings.h"

namespace clsurf::io {

/// The name of the rows of a front, in the plural and as column title.
struct TradeoffWords {
    std::string_view rows = "settings", name = "settings";
    bool only_front = false;  ///< text without dominated rows, except the first and the chosen one
};

/// A table; `*` marks the front, `>` the chosen row. Its last lines state the choice and its reason.
[[nodiscard]] std::string tradeoff_text(const TradeoffFront& front, const TradeoffWords& words = {});

/// One row each, in shown units; column names have units.
[[nodiscard]] std::string tradeoff_csv(const TradeoffFront& front);

/// Keys: rows[] of {number, name, front, chosen, time_s, speed_difference_p95_mm_min, speed_difference_rms_mm_min,
/// jerk_p95_mm_s3, jerk_rms_mm_s3, deepest_um, defects}, with `settings` (one per row, or empty) settings{jerk_percent,
/// acceleration_percent, feed_percent, feed}; weight, chosen (a number or null), diagnostics.
[[nodiscard]] std::string tradeoff_json(const TradeoffFront& front, std::span<const PlanSettings> settings,
                                        const Diagnostics& diagnostics);

}  // namespace clsurf::io
