#pragma once
// Alignment of a measurement with the as-machined surface: the rigid pose for which the measured points lie nearest to it.
//
// First the form alone leads, from the stated start on. Then poses about the result are tried, an eighth of a step-over
// apart, since surfaces with scallops fit nearly as well one step-over beside the right place, and the best of them are
// fitted to the surface with its scallops. The best of these is fitted once more without points that lie too far off: where a
// mark is missing, the others tell the pose. A profile is shifted along itself; where it fits worse than it scatters, poses
// across it are tried, too, and the best is taken if the surface tells it. A result is refused where the data do not determine it: too few points, a
// degree of freedom that the surface does not hold (a plane can be shifted), or a second pose that fits as well.

#include <optional>
#include <string>
#include <vector>

#include "machined/as_machined_surface.h"
#include "measured/measured_data.h"
#include "measured/pose_fit.h"

namespace clsurf {

/// Where a measurement begins: its origin on the part, and the angle from the part's X axis to its own.
struct MeasuredPlace {
    Vec2 origin = Vec2::Zero();  ///< [mm]
    double angle = 0;            ///< [rad]
};

struct AlignRules {
    std::optional<MeasuredPlace> start;  ///< nothing: points are in the axes of the part; others need one
    std::optional<FreeAxes> free;        ///< nothing: all; of a profile x, z and b
    double search = 0;                   ///< [mm] about the start; 0: 1 mm, or three step-overs where they are more
};

/// One degree of freedom, in the axes that the measurement has at its start, about the centre of its points.
struct PoseParameter {
    PoseAxis axis = PoseAxis::x;
    bool fitted = false;
    double value = 0;           ///< [mm or rad] against the start
    double standard_error = 0;  ///< of a fitted one; the scatter of neighbouring points is not taken as independent
};

struct Alignment {
    Pose pose;
    std::vector<PoseParameter> parameters;
    std::size_t points = 0;            ///< that were measured
    std::size_t used = 0;              ///< for the fit; of more than 5,000 points some are passed over evenly
    std::size_t left_out = 0;          ///< of those: too far from the surface, or where nothing was cut
    double rms = 0;                    ///< [mm] distance of the used points from the surface, along its normal
    double worst = 0;                  ///< [mm] the greatest, of all
    double scatter = 0;                ///< [mm] from one point to the next along a profile or a row of a map; points: 0
    double correlated = 1;             ///< how many neighbouring points scatter as one
    std::vector<std::string> reasons;  ///< why the pose is not determined, as sentences; empty: it is

    [[nodiscard]] bool determined() const { return reasons.empty(); }
};

/// Why a determined pose may be wrong all the same: its distances are far above what the scatter of the data explains.
[[nodiscard]] std::optional<std::string> misfit_of(const Alignment& alignment);

/// Free by default.
[[nodiscard]] FreeAxes usual_free_axes(MeasuredKind kind);
/// "x", "a" …
[[nodiscard]] std::string_view name_of(PoseAxis axis);

/// `as_machined` has a step-over. Throws UsageError: a profile with other free axes than x, z and b. Parallel.
[[nodiscard]] Alignment align(const MeasuredData& measured, const AsMachinedSurface& as_machined,
                              const AlignRules& rules = {});

}  // namespace clsurf
