#pragma once
// What lint finds, as text, JSON and SARIF 2.1.0.

#include <span>
#include <string>

#include "core/diagnostic.h"
#include "lint/lint.h"

namespace clsurf::io {

/// What lint found in one program.
struct ReportedLint {
    std::string program;  ///< its name
    LintReport report;
    Diagnostics diagnostics;
};

/// Summaries first (a line a program, worst first, where there are several), then one line a finding, "part.nc:120:
/// warning: … [point-spacing]".
[[nodiscard]] std::string lint_text(std::span<const ReportedLint> programs);
/// Keys: programs[]{program, findings[]{rule, severity, lines, beside_lines, pass, position_mm, tip_mm, contact_mm
/// (where the tool is known), found, expected, unit, text}, summary, diagnostics[]}; of one program its keys besides.
[[nodiscard]] std::string lint_json(std::span<const ReportedLint> programs);
/// One run for all programs, one result a finding on its lines.
[[nodiscard]] std::string lint_sarif(std::span<const ReportedLint> programs);

}  // namespace clsurf::io
