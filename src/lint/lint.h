#pragma once
// Lint: problems in a program itself, found without a log: places where a pass is programmed differently
// from the adjacent passes, so that a controller runs it differently, and places that no controller
// runs well. To add a rule: one row in lint_rules.cpp.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/cutter_place.h"
#include "surface/programmed_surface.h"

namespace clsurf {

struct LintRule;  // lint_rule.h

/// A run of lines that breaks a rule.
struct LintFinding {
    const LintRule* rule = nullptr;
    Severity severity = Severity::warning;
    LineNumber first_line = 0, last_line = 0;
    LineNumber beside_first = 0, beside_last = 0;  ///< lines of a neighbour pass at that place; 0: none
    std::int64_t pass = 0;                         ///< number of the cut pass, from 1; 0: none
    PointIndex point = 0;                          ///< of the programmed surface, where it is worst …
    CutterPlace place;                             ///< … and what lies there
    double found = 0,
           expected =
               0;  ///< mm, or mm/s for feeds: the worst value (of spacings the median) and what it is measured by
};

struct LintThresholds {
    double spacing_ratio = 2;  ///< spacing against that of both neighbours, either way
    double feed_ratio = 1.02;  ///< feeds, likewise
    double tolerance = 0;      ///< [mm] of the controller; 0: what the program sets, else the chord rule is left out
    /// The controller's tolerance over the program's chord error: below the first it copies the facets, above
    /// the second it blurs what the points say.
    double least_tolerance_ratio = 1.1, most_tolerance_ratio = 2.0;
    double reversed_share = 0.5;  ///< of the usual spacing: longer lines that run back are meant
    double start_step_overs = 1;  ///< how far a pass's end may lie out of line
};

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
