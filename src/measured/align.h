#pragma once
// Alignment of a measurement with the as-machined surface: the rigid pose for which the measured points are nearest to it.
//
// The first fit uses the form alone, from the stated start. Then poses around it are tried, an eighth of a step-over apart,
// because a surface with scallops fits nearly as well one step-over away from the right place. The best of them are fitted to
// the surface with its scallops. The best of these is fitted again without outliers: if a mark is missing, the other points
// determine the pose. A profile is only shifted along itself. If its residuals exceed its scatter, poses across it are also
// tried, and the best is used if the surface determines it. A result is refused if the data do not determine it: too few
// points, a degree of freedom that the surface does not constrain (a plane can be shifted), or a second pose that fits as
// well.

#include <optional>
#include <string>
#include <vector>

#include "machined/as_machined_surface.h"
#include "measured/measured_data.h"
#include "measured/pose_fit.h"

namespace clsurf {

/// Where a measurement begins: its origin on the part, and the angle from the part's X axis to its X axis.
struct MeasuredPlace {
    Vec2 origin = Vec2::Zero();  ///< [mm]
    double angle = 0;            ///< [rad]
};

struct AlignRules {
    std::optional<MeasuredPlace> start;  ///< nullopt: only for points in the axes of the part
    std::optional<FreeAxes> free;        ///< nullopt: all; for a profile x, z and b
    double search = 0;                   ///< [mm] around the start; 0: 1 mm or three step-overs, whichever is larger
};

/// One degree of freedom, in the axes of the measurement at its start, about the centre of its points.
struct PoseParameter {
    PoseAxis axis = PoseAxis::x;
    bool fitted = false;
    double value = 0;           ///< [mm or rad] relative to the start
    double standard_error = 0;  ///< of a fitted value; allows for correlated scatter of neighbouring points
};

struct Alignment {
    Pose pose;
    std::vector<PoseParameter> parameters;
    std::size_t points = 0;            ///< measured points
    std::size_t used = 0;              ///< points used in the fit; more than 5,000 points are evenly thinned
    std::size_t left_out = 0;          ///< excluded points of these: outliers, or where nothing was cut
    double rms = 0;                    ///< [mm] distances of the used points from the surface, along its normal
    double worst = 0;                  ///< [mm] the largest of all distances
    double scatter = 0;                ///< [mm] between neighbours along a profile or a row of a map; points: 0
    double correlated = 1;             ///< number of neighbouring points with correlated scatter
    std::vector<std::string> reasons;  ///< why the pose is not determined, as sentences; empty: it is

    [[nodiscard]] bool determined() const { return reasons.empty(); }
};

/// Why a determined pose may still be wrong: its distances are far above the scatter of the data.
[[nodiscard]] std::optional<std::string> misfit_of(const Alignment& alignment);

/// The degrees of freedom that are free by default.
[[nodiscard]] FreeAxes usual_free_axes(MeasuredKind kind);
/// "x", "a" …
[[nodiscard]] std::string_view name_of(PoseAxis axis);

/// `as_machined` must have a step-over. Throws UsageError: a profile with other free axes than x, z and b. Parallel.
[[nodiscard]] Alignment align(const MeasuredData& measured, const AsMachinedSurface& as_machined,
                              const AlignRules& rules = {});

}  // namespace clsurf
