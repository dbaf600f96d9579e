#pragma once
// Exceeded limits in the reports of `check`. Used inside io only.

#include <string>

#include "io/files/json_value.h"
#include "limits/limit_report.h"
#include "program/program.h"

namespace clsurf::io {

/// Keys: docs/limits.md.
[[nodiscard]] Json limits_json(const LimitReport& report, const Program& program);
[[nodiscard]] Json judged_limits_json(const LimitReport& report);

/// A verdict, and a table of the worst findings.
[[nodiscard]] std::string limits_text(const LimitReport& report, const Program& program);

/// The titles of the columns after those shared with defects.
[[nodiscard]] std::string_view limit_column_titles();
/// Rows as in quality_csv(), numbered from `id`.
[[nodiscard]] std::string limits_csv(const LimitReport& report, std::size_t id);

/// Adds results, and their rules to `rules`.
void add_limits_sarif(const LimitReport& report, const Program& program, const std::string& log, Json& rules,
                      Json& results);

}  // namespace clsurf::io
