#pragma once
// AsMachinedReport: roughness and marks of a part. The depth of a defect comes from a profile across it, after the adjacent
// passes have cut.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/not_finite.h"
#include "machined/as_machined_surface.h"
#include "machined/form.h"
#include "machined/part_roughness.h"
#include "predictor/defects.h"

namespace clsurf {

/// Why the depth of a defect in the as-machined surface is not known, or differs from the one that its pass alone would leave.
enum class MarkNote : std::uint8_t {
    none,
    unknown_form,   ///< the form is not known there, for example at a crease, a fillet or a border
    uneven_passes,  ///< the adjacent passes differ from each other by as much, so there is no reference level
    cut_away,       ///< a bulge that the adjacent passes cut down
    other_passes,   ///< deeper or shallower, because adjacent passes deviate as well
};

/// Name for text and JSON: "unknown_form" …; none: "".
[[nodiscard]] std::string_view name_of(MarkNote note);

/// A defect in the as-machined surface.
struct AsMachinedMark {
    double depth = missing<double>;  ///< [mm] ≥ 0; NaN: not known
    MarkNote note = MarkNote::none;
};

struct AsMachinedReport {
    PartRoughness roughness;
    double scallop = 0;                 ///< [mm] usual_scallop(); 0: not known
    std::vector<AsMachinedMark> marks;  ///< per defect of the report
};

/// The depth of a mark in the middle of a profile that extends over some step-overs to each side: the distance of the lowest
/// place within one step-over below the usual valley (`pit`), or of the highest place above the usual cusp. The usual value is
/// the median over sections of one step-over, in pairs symmetric about the middle. If these scatter (forward and backward
/// passes lag to opposite sides), only every second pair counts, whose passes have the direction of the mark.
[[nodiscard]] AsMachinedMark mark_depth(std::span<const double> deviation, double step, double step_over, bool pit);

/// The form that a mark at a point is measured from.
[[nodiscard]] Form::Of form_about_mark(const AsMachinedSurface& as_machined, PointIndex point);

/// The usual height [mm] of the cusp between adjacent passes of a ball: the median over places spread over the part, each
/// computed from the distance between its contact points and the curvature of the surface across the feed (scallop.h). 0: the
/// tool is not a ball, or no place has neighbours. O(10⁴ points).
[[nodiscard]] double usual_scallop(const AsMachinedSurface& as_machined, const Signals& signals);

/// The heights [mm] whose median is usual_scallop(), but only at places among `points`.
[[nodiscard]] std::vector<double> scallop_heights(const ClSurface& surface, const Signals& signals,
                                                  const CuttingTool& tool, const PointRange& points);

/// Roughness of a surface, and marks of every defect of `report`. `commanded`: the surface swept along the commanded positions;
/// nullptr: not known. `scallops`: scallop_heights() of all points; nullptr: they are computed. Parallel. `forget`: called
/// between places.
[[nodiscard]] AsMachinedReport measure_as_machined(const AsMachinedSurface& as_machined, const Signals& signals,
                                                   const QualityReport& report,
                                                   const AsMachinedSurface* commanded = nullptr,
                                                   const std::vector<double>* scallops = nullptr,
                                                   const ForgetBlocks& forget = {});

}  // namespace clsurf
