#pragma once
// AsMachinedReport: roughness and marks of a part. A profile across each defect gives its depth after its neighbours have
// cut.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/not_finite.h"
#include "machined/as_machined_surface.h"
#include "machined/form.h"
#include "machined/part_roughness.h"
#include "predictor/defects.h"

namespace clsurf {

/// Why a defect has no depth in the as-machined surface, or another one than its pass alone would leave.
enum class MarkNote : std::uint8_t {
    none,
    unknown_form,   ///< the form is not known there: a crease, a fillet or a border
    uneven_passes,  ///< the adjacent passes differ from each other by as much: no level to measure from
    cut_away,       ///< a bulge that the adjacent passes cut down
    other_passes,   ///< deeper or shallower, since adjacent passes run off by themselves
};

/// For text and JSON: "unknown_form" …; none: "".
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

/// A mark in the middle of a profile over some step-overs to each side: how far the lowest place within
/// one step-over is below the usual valley (`pit`), or the highest above the usual cusp. Usual: the median
/// over pieces of a step-over's length, paired about the middle; where these differ (passes to and fro lag
/// to opposite sides), over every second pair, which are passes of the mark's own direction.
[[nodiscard]] AsMachinedMark mark_depth(std::span<const double> deviation, double step, double step_over, bool pit);

/// The form that a mark at a point is measured from.
[[nodiscard]] Form::Of form_about_mark(const AsMachinedSurface& as_machined, PointIndex point);

/// The usual height [mm] of the cusp between adjacent passes of a ball: the median over places spread over the part, each
/// with the distance between its contact points and the surface's curvature across the feed (scallop.h). 0: not a
/// ball, or no place has neighbours. O(10⁴ points).
[[nodiscard]] double usual_scallop(const AsMachinedSurface& as_machined, const Signals& signals);

/// The heights [mm] of which usual_scallop() is the median, at those of its places that are among `points`.
[[nodiscard]] std::vector<double> scallop_heights(const ClSurface& surface, const Signals& signals,
                                                  const CuttingTool& tool, const PointRange& points);

/// Of a surface and every defect of `report`. `commanded`: swept along the commanded positions; nullptr: not known.
/// `scallops`: scallop_heights() of all points; nullptr: they are looked for. Parallel. `forget`: called between places.
[[nodiscard]] AsMachinedReport measure_as_machined(const AsMachinedSurface& as_machined, const Signals& signals,
                                                   const QualityReport& report,
                                                   const AsMachinedSurface* commanded = nullptr,
                                                   const std::vector<double>* scallops = nullptr,
                                                   const ForgetBlocks& forget = {});

}  // namespace clsurf
