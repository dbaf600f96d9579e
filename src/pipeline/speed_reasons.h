#pragma once
// The reasons why the tool is slow at a point, in words, from the log and the program.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "field/field_set.h"
#include "pipeline/part.h"

namespace clsurf {

struct SpeedReasons {
    double programmed_feed = 0;        ///< [mm/s]; NaN: not known
    std::vector<std::string> reasons;  ///< the most certain first; empty: as fast as programmed
};

/// "limited by the jerk" (from a simulated log), "acceleration of Z at 98 % of its limit" (if the part has a machine),
/// "blocks of 0.02 mm", "a corner of 35° in line 12", "feed override 50 %". If there is none of these, the text says that
/// nothing explains the speed. `speed` at the point [mm/s]; from 95 % of the programmed feed on there is no reason.
/// O(blocks nearby).
[[nodiscard]] SpeedReasons speed_reasons(const Part& part, PointIndex point, double speed);
/// "634 of F3000 mm/min: blocks of 0.02 mm; …"; empty without reasons. `speed` at the point [mm/s].
[[nodiscard]] std::string words_of(const SpeedReasons& why, double speed);
/// The reasons at each of many points, as pieces of text; each different piece is stored once.
struct SlowWords {
    std::vector<std::int64_t> speeds;  ///< [mm/min] rounded; if the tool is not slow, the value of the previous point
    std::vector<std::string> pieces{""};              ///< the first is empty
    std::vector<std::vector<std::uint32_t>> columns;  ///< each has the index of a piece for each point
};
/// For ascending `points`. The speed and the pieces of a point, one from each column, give words_of(); all pieces are empty
/// if the tool is not slow. No columns: it is slow at no point. `speeds` at every point of the log [mm/s]; empty: not
/// known. O(points), parallel.
[[nodiscard]] SlowWords slow_words(const Part& part, std::span<const PointIndex> points, std::span<const float> speeds);
/// "slow at point 4848: 634 of F3000 mm/min: …; point …", for the points at which the tool is slow; empty: there are none.
[[nodiscard]] std::string slow_points(const std::vector<PointIndex>& points, const Part& part, const FieldSet& fields);

}  // namespace clsurf
