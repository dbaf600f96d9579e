#pragma once
// AsMachinedReport: roughness and marks of a part, measured on patches of its as-machined surface, so that the
// cost does not grow with the part. Patches spread evenly over the cutting points give the roughness. A
// profile across each defect gives its depth after its neighbours have cut.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/not_finite.h"
#include "machined/form.h"
#include "machined/roughness.h"
#include "predictor/defects.h"

namespace clsurf {

/// Roughness of a region.
struct RoughPatch {
    PointIndex point = 0;  ///< in its middle
    Vec3 contact;          ///< [mm] of the tool with the surface there
    Roughness profile;     ///< across the feed
    AreaHeights area;      ///< [mm] of a square of two cut-offs, form taken off
    double unknown = 0;    ///< share of the square's cut cells where the form is not known
};

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
    std::vector<RoughPatch>
        patches;               ///< that could be measured, in the order of their points; none: nothing below is known
    double ra = 0, rz = 0;     ///< [mm] mean over the patches' profiles across the feed
    std::size_t roughest = 0;  ///< patch whose profile has the greatest Rz
    double sa = 0, sq = 0;     ///< [mm] mean over the patches, form taken off
    double sz = 0;             ///< [mm] of the roughest patch
    double cutoff = 0;         ///< [mm] of the profiles' filter
    double scallop = 0;        ///< [mm] usual_scallop(); 0: not known
    double unknown = 0;  ///< share of the patches' cut cells where the form is not known: nothing is measured there
    std::vector<AsMachinedMark> marks;  ///< per defect of the report
};

/// A profile across the formed surface.
struct AsMachinedProfile {
    double step = 0;                   ///< [mm] between values
    std::vector<double> deviation;     ///< [mm] over the form; NaN: nothing was cut, or no form there
    std::size_t first = 0, count = 0;  ///< the longest section without gaps …
    Roughness roughness;               ///< … and its roughness
};

/// From one place to another [mm], both ends included, a value at least every 1/200 of a step-over.
[[nodiscard]] AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& to);

/// A mark in the middle of a profile over some step-overs to each side: how far the lowest place within
/// one step-over is below the usual valley (`pit`), or the highest above the usual cusp. Usual: the median
/// over pieces of a step-over's length, paired about the middle; where these differ (passes to and fro lag
/// to opposite sides), over every second pair, which are passes of the mark's own direction.
[[nodiscard]] AsMachinedMark mark_depth(std::span<const double> deviation, double step, double step_over, bool pit);

/// The usual height [mm] of the cusp between adjacent passes of a ball: the median over places spread over the part, each
/// with the distance between its contact points and the surface's curvature across the feed (scallop.h). 0: not a
/// ball, or no place has neighbours. O(10⁴ points).
[[nodiscard]] double usual_scallop(const AsMachinedSurface& as_machined, const Signals& signals);

/// Some 24 patches and every defect of `report`. Parallel.
[[nodiscard]] AsMachinedReport measure_as_machined(const AsMachinedSurface& as_machined, const Signals& signals,
                                                   const QualityReport& report);

}  // namespace clsurf
