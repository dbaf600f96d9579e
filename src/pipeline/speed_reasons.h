#pragma once
// Why the tool is slow at a point, in words: what the log and the program say of it.

#include <string>
#include <vector>

#include "field/field_set.h"
#include "pipeline/part.h"

namespace clsurf {

struct SpeedReasons {
    double programmed_feed = 0;        ///< [mm/s]; NaN: none is known
    std::vector<std::string> reasons;  ///< the surest first; empty: as fast as programmed
};

/// "limited by the jerk" (a simulated log says so), "acceleration of Z at 98 % of its limit" (the part knows its machine),
/// "blocks of 0.02 mm", "a corner of 35° in line 12", "feed override 50 %"; if there are none of these, that nothing explains
/// it. `speed` at the point [mm/s]; none is given for
/// 95 % of the programmed feed or more. O(blocks nearby).
[[nodiscard]] SpeedReasons speed_reasons(const Part& part, PointIndex point, double speed);
/// "634 of F3000 mm/min: blocks of 0.02 mm; …"; empty without reasons. `speed` at the point [mm/s].
[[nodiscard]] std::string words_of(const SpeedReasons& why, double speed);
/// "slow at point 4848: 634 of F3000 mm/min: …; point …", for those points at which the tool is slow; empty: at none.
[[nodiscard]] std::string slow_points(const std::vector<PointIndex>& points, const Part& part, const FieldSet& fields);

}  // namespace clsurf
