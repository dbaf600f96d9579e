#pragma once
// Contact: where a rotating tool touches the surface, computed from its tip (the CL point) and the surface
// normal. Three axes: the tool axis is +z. A ball is a torus whose tube has the radius of the tool, a flat
// tool one whose tube has none, so one formula serves all three tools.

#include "core/geometry.h"
#include "machined/tool.h"

namespace clsurf {

/// Height [mm] of the tool's outline over its tip, `rho` [mm] from the axis; infinite beyond its radius.
[[nodiscard]] double outline_height(const CuttingTool& tool, double rho);

/// How deep [mm] a place lies inside a tool, normal to its outline, to first order; ≤ 0: outside. `off`
/// [mm]: from the tip.
[[nodiscard]] double depth_inside(const CuttingTool& tool, const Vec3& off);

/// From the tip to the cutter-contact point [mm], for a unit normal out of the part, n.z ≥ 0:
/// c ẑ − (R − c) n_xy/|n_xy| − c n with radius R and corner radius c. Where the normal is the axis, a
/// flat bottom touches with all of itself: its middle, the tip, is given.
[[nodiscard]] Vec3 contact_offset(const CuttingTool& tool, const Vec3& normal);
/// The same of a tool whose axis is any unit vector `axis`, normal · axis ≥ 0.
[[nodiscard]] Vec3 contact_offset(const CuttingTool& tool, const Vec3& normal, const Vec3& axis);

}  // namespace clsurf
