#pragma once
// Lint: problems in a program itself, found without a log: places where a pass is programmed differently
// from the adjacent passes, so that a controller runs it differently, and places that no controller
// runs well. To add a rule: one row in lint_rules.cpp.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lint/lint_finding.h"

namespace clsurf {

struct LintReport {
    std::span<const LintRule> rules;    ///< that were checked
    std::vector<LintFinding> findings;  ///< by rule, then by line
    std::int64_t passes = 0;
    double step_over = 0;      ///< [mm]; 0: nothing to compare with
    double spacing = 0;        ///< [mm] median length of the cutting lines
    double chord_error = 0;    ///< [mm] 95th percentile over the way of the lines that bend
    double tolerance = 0;      ///< [mm] it is held against; 0: not known
    double not_finishing = 0;  ///< share of the cutting that is pockets, drilling or single contours, 0 … 1
    /// Whether passes were compared: not where most of the cutting is none of finishing passes.
    [[nodiscard]] bool judged() const { return step_over > 0 && not_finishing <= 0.5; }
    /// Findings of the rule of that name.
    [[nodiscard]] std::size_t count(std::string_view rule) const;
    /// Findings that are more than notes.
    [[nodiscard]] std::size_t warnings() const;
};

/// The tolerance that the program asks the controller for ("G64 P0.01", "CYCLE832(0.02,…)") [mm]; the
/// smallest where there are several, 0 where there is none.
[[nodiscard]] double programmed_tolerance(const Program& program);

/// Our rules: rows of lint_rules.cpp.
[[nodiscard]] std::span<const LintRule> lint_rules();

/// Checks each of `rules`, which must outlive the report. O(points).
[[nodiscard]] LintReport lint(const Program& program, const ProgrammedSurface& programmed,
                              const LintThresholds& thresholds = {}, std::span<const LintRule> rules = lint_rules());

}  // namespace clsurf
