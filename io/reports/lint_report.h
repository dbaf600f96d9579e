#pragma once
// What lint finds, as text, JSON and SARIF 2.1.0.

#include <string>

#include "core/diagnostic.h"
#include "lint/lint.h"

namespace clsurf::io {

struct ReportedLint {
    const LintReport* report = nullptr;
    const Program* program = nullptr;
    const Diagnostics* diagnostics = nullptr;
};

/// One line a finding, "part.nc:120: warning: … [point-spacing]", and a summary.
[[nodiscard]] std::string lint_text(const ReportedLint& lint);
/// Keys: findings[]{rule, severity, lines, beside_lines, pass, position_mm, tip_mm, contact_mm (where the tool is known), found, expected, unit, text}, summary, diagnostics[].
[[nodiscard]] std::string lint_json(const ReportedLint& lint);
/// One result per finding on its lines.
[[nodiscard]] std::string lint_sarif(const ReportedLint& lint);

}  // namespace clsurf::io
