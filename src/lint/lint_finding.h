#pragma once
// LintFinding: a problem that a rule of lint found, and LintThresholds: the values beyond which something is a problem.

#include "core/cutter_place.h"
#include "surface/programmed_surface.h"

namespace clsurf {

struct LintRule;  // lint_rule.h

/// A run of lines that breaks a rule.
struct LintFinding {
    const LintRule* rule = nullptr;
    Severity severity = Severity::warning;
    LineNumber first_line = 0, last_line = 0;
    LineNumber beside_first = 0, beside_last = 0;  ///< lines of an adjacent pass at that place; 0: none
    std::int64_t pass = 0;                         ///< number of the cut pass, from 1; 0: none
    PointIndex point = 0;                          ///< point of the programmed surface at the worst place …
    CutterPlace place;                             ///< … and the position there
    double found = 0,
           expected = 0;  ///< mm, or mm/s for feeds: the worst value (for spacings the median) and its reference
};

struct LintThresholds {
    double spacing_ratio = 2;  ///< ratio of the spacing to that of both neighbours, or its inverse
    double feed_ratio = 1.02;  ///< ratio of feeds, likewise
    double tolerance = 0;      ///< [mm] of the controller; 0: the program's; if it has none either, no chord rule
    /// Ratio of the controller's tolerance to the program's chord error. Below the first value the controller reproduces
    /// the facets; above the second one it smooths away details of the points.
    double least_tolerance_ratio = 1.1, most_tolerance_ratio = 2.0;
    double reversed_share = 0.5;  ///< of the usual spacing: longer lines that run back are intentional
    double start_step_overs = 1;  ///< greatest deviation of a pass's end from the line through adjacent ends
};

}  // namespace clsurf
