#pragma once
// The findings of lint as text, JSON and SARIF 2.1.0.

#include <span>
#include <string>

#include "core/diagnostic.h"
#include "lint/lint.h"

namespace clsurf::io {

/// The findings of lint in one program.
struct ReportedLint {
    std::string program;  ///< its name
    LintReport report;
    Diagnostics diagnostics;
};

/// Summaries first (for several programs one line each, worst first), then one line per finding, "part.nc:120:
/// warning: … [point-spacing]".
[[nodiscard]] std::string lint_text(std::span<const ReportedLint> programs);
/// Keys: programs[]{program, findings[]{rule, severity, lines, beside_lines, pass, position_mm, tip_mm, contact_mm
/// (if the tool is known), found, expected, unit, text}, summary, diagnostics[]}; for one program also its keys at the top
/// level.
[[nodiscard]] std::string lint_json(std::span<const ReportedLint> programs);
/// One run for all programs, one result per finding at its lines.
[[nodiscard]] std::string lint_sarif(std::span<const ReportedLint> programs);

}  // namespace clsurf::io
