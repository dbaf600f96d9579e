#pragma once
// The NC program of a cut along a profile: approach, lines or splines in X and Z, retract.

#include <string>
#include <string_view>
#include <vector>

#include "scan/cut_path.h"

namespace clsurf {

struct CutProgramRules {
    std::string_view dialect = "linuxcnc";
    std::string_view name;   ///< of the source, for the comment
    double feed = 0;         ///< [mm/min]
    double clearance_z = 0;  ///< [mm] height of the approach and the retract
    double y = 0;            ///< [mm] plane of the cut
};

/// Decimals of coordinates: 0.1 µm.
inline constexpr int cut_decimals = 4;

/// Whether a dialect has splines in the XZ plane: POLY of siemens and SPL of klartext, one cubic a block, and G06.2 of fanuc.
[[nodiscard]] bool writes_spans(std::string_view dialect);

/// Lines between points. `points`: at least two.
[[nodiscard]] std::string line_program(const std::vector<Vec2>& points, const CutProgramRules& rules);
/// A spline per span; a line at a gap between two spans. Domain: writes_spans().
[[nodiscard]] std::string span_program(const std::vector<CutSpan>& spans, const CutProgramRules& rules);

}  // namespace clsurf
