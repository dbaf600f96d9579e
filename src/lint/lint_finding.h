#pragma once
// LintFinding: a problem that a rule of lint found, and LintThresholds: from where on it is one.

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

}  // namespace clsurf
