#pragma once
// StatedAxes: the tool axis of each motion as the program states it. Tilted planes (CYCLE800, G68.2 with G53.1, PLANE) state
// it as a vector that stays while the tool cuts: no kinematics are needed to know how the tool stands to the part.

#include <cstdint>
#include <optional>

#include "program/motion.h"

namespace clsurf {

struct StatedAxes {
    Column<Xyz> axis;  ///< by motion, a unit vector in the coordinates of the motions; empty: along z all the time
    /// The first cut whose axis only kinematics tell: an angle of A or B, or an axis that turns while the tool cuts.
    std::optional<std::int64_t> unknown;
};

/// Motions whose angles are those that a tilted plane left keep its axis. O(motions).
[[nodiscard]] StatedAxes stated_axes(const Motions& motions);

}  // namespace clsurf
