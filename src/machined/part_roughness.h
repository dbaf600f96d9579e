#pragma once
// PartRoughness: the roughness of a part, measured at places that are spread evenly over its cutting points, so the cost does
// not grow with the part. Two runs of a part are compared at the same places and with the same form.

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
    double apart = 0;  ///< [mm] between contacts of adjacent passes there, seen from above; 0: not known
};

/// Some 24 places.
[[nodiscard]] std::vector<RoughnessPlace> roughness_places(const AsMachinedSurface& as_machined,
                                                           const Signals& signals);

/// Roughness of a region.
struct RoughPatch {
    PointIndex point = 0;  ///< in its middle
    Vec3 contact;          ///< [mm] of the tool with the surface there
    Roughness profile;     ///< across the feed
    AreaHeights area;      ///< [mm] of a window, form subtracted: PatchWindow in part_roughness.cpp
    AreaHeights machine;   ///< [mm] of the same window: the contribution of the machine (deviation_from())
    double unknown = 0;    ///< share of the window's cut cells where the form is not known
};

struct PartRoughness {
    std::vector<RoughPatch> patches;  ///< measured patches in the order of their points; none: no value below is known
    double ra = 0, rz = 0;            ///< [mm] mean over the patches' profiles across the feed
    std::size_t roughest = 0;         ///< patch whose profile has the greatest Rz
    double sa = 0, sq = 0;            ///< [mm] mean over the patches, form subtracted
    double sz = 0;                    ///< [mm] of the roughest patch
    double cutoff = 0;                ///< [mm] of the profiles' filter
    double unknown = 0;               ///< share of the patches' cut cells without a known form: these are not measured
    /// [mm] The contribution of the machine: sa and sq are means over all patches, sz is the largest; no cells: not known.
    AreaHeights machine;
};

/// Reduces two runs, measured at the same places, to the places where both are known. Nothing changes if these are the same.
void keep_common_patches(PartRoughness& a, PartRoughness& b);

/// The measured surface and its references.
struct RoughnessSurfaces {
    const AsMachinedSurface& measured;
    const AsMachinedSurface& form_of;              ///< its contact points define the form
    const AsMachinedSurface* commanded = nullptr;  ///< swept along the commanded positions; nullptr: not known
};

/// Cells of a map of `measured` minus those of the same map of `commanded`, along the normal of the latter [mm]: what following
/// errors add to scallops and form. It needs no form, so it is also known at creases and in fillets.
[[nodiscard]] std::vector<float> deviation_from(const AsMachinedSurface& commanded, const AsMachinedSurface& measured,
                                                const MapFrame& frame);

/// Parallel. `forget`: called between places.
[[nodiscard]] PartRoughness measure_roughness(const RoughnessSurfaces& surfaces, std::span<const RoughnessPlace> places,
                                              const ForgetBlocks& forget = {});

}  // namespace clsurf
