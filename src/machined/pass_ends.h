#pragma once
// Near the ends of passes the cusps are too high. The cusp between two contacts of adjacent passes is cut before or after
// these contacts, and the section of the pass that would cut it is missing. To second order, the height of the tool above its
// contact is half of
//     w² f² / r + sin θ c² / (R − r + r sin θ)
// (seen from above: f along the fall line of the surface, c along its contour line; θ its slope, w = 1 / cos θ; tool radius R,
// corner r). Let K be the matrix of this form, u the feed and v the direction across. Half a step-over aside along v, the
// height is least at a distance of uᵀKv / uᵀKu half step-overs along u. This is 0 for a feed along the fall line or the contour
// line, up to 0.35 for a ball on a plane of 45°, and several for a bull-nose tool on a gentle slope.

#include <span>

#include "core/geometry.h"
#include "machined/form.h"
#include "machined/tool.h"

namespace clsurf {

/// Distance along the feed from the contacts to where the cusp between adjacent passes is cut [mm], seen from above. `slope`:
/// of the surface, along the feed and across it. `apart` [mm]: between contacts across the feed, seen from above. At most
/// √(R · apart): farther away, the tool's circle has left the place.
[[nodiscard]] double cusp_before_contact(const CuttingTool& tool, const Vec2& slope, double apart);

/// Tests whether places of a window are cut completely before the passes end. For a flat tool the distance is 0.
class BeforePassEnds {
public:
    /// `heights` [mm]: of the cells of `frame`, whose rows run along the feed; slopes are those of one fitted quadratic.
    /// `apart` [mm]: as above. `form` must outlive this. O(cells).
    BeforePassEnds(const Form& form, const CuttingTool& tool, double apart, const MapFrame& frame,
                   std::span<const float> heights);

    [[nodiscard]] bool has(const Vec2& place) const;

private:
    const Form* form_;
    Vec2 before_ = Vec2::Zero();  ///< [mm] from the contacts to where the tool cuts the cusps
};

}  // namespace clsurf
