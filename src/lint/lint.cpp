#include "lint/lint.h"

#include <algorithm>
#include <cmath>

#include "lint/lint_rule.h"

namespace clsurf {

std::size_t LintReport::count(std::string_view rule) const {
    return static_cast<std::size_t>(
        std::count_if(findings.begin(), findings.end(), [&](const LintFinding& f) { return f.rule->name == rule; }));
}

std::size_t LintReport::warnings() const {
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                  [](const LintFinding& f) { return f.severity != Severity::note; }));
}

double programmed_tolerance(const Program& program) {
    double least = 0;
    for (const ProgramEvent& event : program.events) {
        const PathMode* const mode = event.path_mode();
        if (mode == nullptr || mode->block_end != BlockEnd::rounded) continue;
        const double tolerance = mode->tolerance;
        if (std::isfinite(tolerance) && (least == 0 || tolerance < least)) least = tolerance;
    }
    return least;
}

LintReport lint(const Program& program, const ProgrammedSurface& programmed, const LintThresholds& thresholds,
                std::span<const LintRule> rules) {
    const LintContext context(program, programmed, thresholds);
    LintReport report;
    report.rules = rules;
    report.passes = static_cast<std::int64_t>(context.passes().size());
    report.step_over = programmed.surface.step_over;
    report.spacing = context.spacing();
    report.chord_error = context.chord_error();
    report.tolerance = context.tolerance();
    const PointIndex all = cutting_points(programmed.surface.passes) + programmed.surface.not_finishing;
    if (all > 0)
        report.not_finishing = static_cast<double>(programmed.surface.not_finishing) / static_cast<double>(all);
    // If most of the cutting is not finishing, adjacent passes are accidental.
    if (report.not_finishing > 0.5) return report;
    for (const LintRule& rule : rules) {
        std::vector<LintFinding> found;
        rule.check(context, rule, found);
        std::stable_sort(found.begin(), found.end(),
                         [](const LintFinding& a, const LintFinding& b) { return a.first_line < b.first_line; });
        report.findings.insert(report.findings.end(), found.begin(), found.end());
    }
    return report;
}

}  // namespace clsurf
