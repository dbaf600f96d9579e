#pragma once
// Lint: problems in a program, found without a log. Places at which a pass is programmed differently from the adjacent
// passes, so that a controller runs it differently, and places that no controller runs well. To add a rule: one row in
// lint_rules.cpp.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lint/lint_finding.h"

namespace clsurf {

struct LintReport {
    std::span<const LintRule> rules;    ///< the checked rules
    std::vector<LintFinding> findings;  ///< by rule, then by line
    std::int64_t passes = 0;
    double step_over = 0;      ///< [mm]; 0: there are no adjacent passes to compare
    double spacing = 0;        ///< [mm] median length of the cutting lines
    double chord_error = 0;    ///< [mm] 95th percentile over the length of the lines that bend
    double tolerance = 0;      ///< [mm] compared with the chord error; 0: not known
    double not_finishing = 0;  ///< share of the cutting in pockets, drilling or single contours, 0 … 1
    /// Whether passes were compared. They are not if most of the cutting is not finishing.
    [[nodiscard]] bool judged() const { return step_over > 0 && not_finishing <= 0.5; }
    /// Number of findings of the rule with that name.
    [[nodiscard]] std::size_t count(std::string_view rule) const;
    /// Number of findings that are more than notes.
    [[nodiscard]] std::size_t warnings() const;
};

/// The tolerance that the program sets in the controller ("G64 P0.01", "CYCLE832(0.02,…)") [mm]; the smallest if there are
/// several, 0 if there is none.
[[nodiscard]] double programmed_tolerance(const Program& program);

/// The built-in rules: rows of lint_rules.cpp.
[[nodiscard]] std::span<const LintRule> lint_rules();

/// Checks each of `rules`, which must outlive the report. O(points).
[[nodiscard]] LintReport lint(const Program& program, const ProgrammedSurface& programmed,
                              const LintThresholds& thresholds = {}, std::span<const LintRule> rules = lint_rules());

}  // namespace clsurf
