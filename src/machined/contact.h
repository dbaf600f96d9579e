#pragma once
// Contact: where a rotating tool touches the surface, computed from its tip (the CL point) and the surface normal. Three axes:
// the tool axis is +z. A ball is a torus whose tube radius is the tool's radius, and a flat tool is a torus with tube radius
// 0,
// so one formula covers all three tools.

#include "core/geometry.h"
#include "machined/tool.h"

namespace clsurf {

/// Height [mm] of the tool's outline above its tip, at `rho` [mm] from the axis; infinite beyond its radius.
[[nodiscard]] double outline_height(const CuttingTool& tool, double rho);

/// Depth [mm] of a place inside a tool, normal to its outline, to first order; ≤ 0: outside. `off` [mm]: from the tip.
[[nodiscard]] double depth_inside(const CuttingTool& tool, const Vec3& off);

/// From the tip to the contact point [mm], for a unit normal out of the part, n.z ≥ 0: c ẑ − (R − c) n_xy/|n_xy| − c n with
/// radius R and corner radius c. If the normal is along the axis, the whole flat bottom touches, and its middle, the tip, is
/// returned.
[[nodiscard]] Vec3 contact_offset(const CuttingTool& tool, const Vec3& normal);
/// The same for a tool with any unit vector `axis`, normal · axis ≥ 0.
[[nodiscard]] Vec3 contact_offset(const CuttingTool& tool, const Vec3& normal, const Vec3& axis);

}  // namespace clsurf
