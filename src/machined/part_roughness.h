#pragma once
// PartRoughness: the roughness of a part, measured at places spread evenly over its cutting points, so that the cost does
// not grow with the part. Two runs of a part compare at the same places and over the same form.

#include <span>
#include <vector>

#include "machined/across_feed.h"
#include "machined/as_machined_surface.h"
#include "machined/roughness.h"

namespace clsurf {

/// A place where roughness is measured.
struct RoughnessPlace {
    PointIndex point = 0;
    Vec3 contact = Vec3::Zero();  ///< [mm] of the tool with the surface there
    AcrossFeed across;
    double apart = 0;  ///< [mm] from contact to contact of adjacent passes there, seen from above; 0: not known
};

/// Some 24 of them.
[[nodiscard]] std::vector<RoughnessPlace> roughness_places(const AsMachinedSurface& as_machined,
                                                           const Signals& signals);

/// Roughness of a region.
struct RoughPatch {
    PointIndex point = 0;  ///< in its middle
    Vec3 contact;          ///< [mm] of the tool with the surface there
    Roughness profile;     ///< across the feed
    AreaHeights area;      ///< [mm] of a window, form taken off: PatchWindow in part_roughness.cpp
    AreaHeights machine;   ///< [mm] of the same window: what the machine adds (deviation_from())
    double unknown = 0;    ///< share of the window's cut cells where the form is not known
};

struct PartRoughness {
    std::vector<RoughPatch>
        patches;               ///< that could be measured, in the order of their points; none: nothing below is known
    double ra = 0, rz = 0;     ///< [mm] mean over the patches' profiles across the feed
    std::size_t roughest = 0;  ///< patch whose profile has the greatest Rz
    double sa = 0, sq = 0;     ///< [mm] mean over the patches, form taken off
    double sz = 0;             ///< [mm] of the roughest patch
    double cutoff = 0;         ///< [mm] of the profiles' filter
    double unknown = 0;  ///< share of the patches' cut cells where the form is not known: nothing is measured there
    /// [mm] What the machine adds: sa and sq are means over all patches, sz is the greatest; no cells: not known.
    AreaHeights machine;
};

/// Leaves of two runs, measured at the same places, what is known of both. Nothing changes where they are known at the same
/// places.
void keep_common_patches(PartRoughness& a, PartRoughness& b);

/// What is measured, and against what.
struct RoughnessSurfaces {
    const AsMachinedSurface& measured;
    const AsMachinedSurface& form_of;              ///< the form is that of its contact points
    const AsMachinedSurface* commanded = nullptr;  ///< swept along the commanded positions; nullptr: not known
};

/// Cells of a map of `measured` less those of the same map of `commanded`, along the normal of the latter [mm]: what
/// following errors add to scallops and form. It needs no form, so that it is known at creases and in fillets, too.
[[nodiscard]] std::vector<float> deviation_from(const AsMachinedSurface& commanded, const AsMachinedSurface& measured,
                                                const MapFrame& frame);

/// Parallel. `forget`: called between places.
[[nodiscard]] PartRoughness measure_roughness(const RoughnessSurfaces& surfaces, std::span<const RoughnessPlace> places,
                                              const ForgetBlocks& forget = {});

}  // namespace clsurf
