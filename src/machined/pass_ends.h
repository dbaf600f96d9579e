#pragma once
// Near the ends of passes the cusps are too high: the cusp between two contacts of adjacent passes is cut before or behind these
// contacts, and the part of the pass that would cut it is missing. To second order, the tool stands over its contact by half of
//     w² f² / r + sin θ c² / (R − r + r sin θ)
// (seen from above: f along the fall line of the surface, c along its contour line; θ its slope, w = 1 / cos θ; tool radius R,
// corner r). Along the feed u, half a step-over aside along v, this is least at a distance of uᵀKv / uᵀKu half step-overs,
// K being its matrix: a feed along the fall line or the contour line has 0, a ball on a plane of 45° up to 0.35, and a bull-nose
// tool on a gentle slope several.

#include <span>

#include "core/geometry.h"
#include "machined/form.h"
#include "machined/tool.h"

namespace clsurf {

/// How far along the feed from the contacts the cusp between adjacent passes is cut [mm], seen from above. `slope`: of the surface,
/// along the feed and across it. `apart` [mm]: from contact to contact across the feed, seen from above. At most √(R · apart): farther
/// away, the tool's circle has left the place.
[[nodiscard]] double cusp_before_contact(const CuttingTool& tool, const Vec2& slope, double apart);

/// Tells the places of a window that passes cut before they end. A flat tool has no such distance.
class BeforePassEnds {
public:
    /// `heights` [mm] of the cells of `frame`, whose rows run along the feed; their slopes are those of one quadratic. `apart`
    /// [mm], see above. `form` must outlive this. O(cells).
    BeforePassEnds(const Form& form, const CuttingTool& tool, double apart, const MapFrame& frame,
                   std::span<const float> heights);

    [[nodiscard]] bool has(const Vec2& place) const;

private:
    const Form* form_;
    Vec2 before_ = Vec2::Zero();  ///< [mm] from the contacts to where the tool cuts the cusps
};

}  // namespace clsurf
