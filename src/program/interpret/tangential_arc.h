#pragma once
// Arcs that continue in the direction of the last motion, even if that is no longer in memory.

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "program/interpret/arc.h"
#include "program/motion.h"

namespace clsurf {

class Interpreter;

/// G06, G16 and CT: the arc continues in the direction of the last motion.
void arc_along_tangent(const Interpreter& in, ArcWords& words);
/// Direction at the end of a motion, with the length of the motion or of the radius; for an arc in its own plane.
/// Zero if there is none.
[[nodiscard]] Vec3 tangent_at_end(const Motions& motions, std::int64_t motion);
/// Called before the first `count` motions are removed: keeps what arc_along_tangent() may need of them. If the last
/// direction is normal to the arc's plane, the last one that is not parallel to it is used.
void keep_tangents(std::vector<Vec3>& kept, const Motions& motions, std::int64_t count);

}  // namespace clsurf
