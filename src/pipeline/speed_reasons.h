#pragma once
// Why the tool is slow at a point, in words: what the log and the program say of it.

#include <cstdint>
#include <span>
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
/// Why the tool is slow at each of many points, as pieces of text: each different one is there once.
struct SlowWords {
    std::vector<std::int64_t> speeds;     ///< [mm/min] rounded; where the tool is not slow, that of the point before
    std::vector<std::string> pieces{""};  ///< the first is empty
    std::vector<std::vector<std::uint32_t>> columns;  ///< each has the number of a piece for each point
};
/// Of rising `points`. Speed and pieces of a point, one from each column, are what words_of() says; all pieces are empty
/// where the tool is not slow. No columns: it is slow at none. `speeds` at every point of the log [mm/s];
/// empty: not known. O(points), parallel.
[[nodiscard]] SlowWords slow_words(const Part& part, std::span<const PointIndex> points, std::span<const float> speeds);
/// "slow at point 4848: 634 of F3000 mm/min: …; point …", for those points at which the tool is slow; empty: at none.
[[nodiscard]] std::string slow_points(const std::vector<PointIndex>& points, const Part& part, const FieldSet& fields);

}  // namespace clsurf
