#pragma once
// StatedAxes: the tool axis of each motion as the program states it. Tilted planes (CYCLE800, G68.2 with G53.1, PLANE) state
// it as a vector that is constant while the tool cuts: the orientation of the tool to the part is then known without
// kinematics.

#include <cstdint>
#include <optional>

#include "program/motion.h"

namespace clsurf {

struct StatedAxes {
    Column<Xyz> axis;  ///< by motion, a unit vector in the coordinates of the motions; empty: always along z
    /// The first cut whose axis requires kinematics: an angle of A or B, or an axis that turns while the tool cuts.
    std::optional<std::int64_t> unknown;
};

/// Motions keep the axis of a tilted plane while their angles do not change. O(motions).
[[nodiscard]] StatedAxes stated_axes(const Motions& motions);

}  // namespace clsurf
