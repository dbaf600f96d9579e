#pragma once
// Arcs that go on in the direction of the last motion, even if that is no longer in memory.

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "program/interpret/arc.h"
#include "program/motion.h"

namespace clsurf {

class Interpreter;

/// G06, G16 and CT: the arc goes on in the direction of the last motion.
void arc_along_tangent(const Interpreter& in, ArcWords& words);
/// Direction in which a motion ends, as long as its way or radius; of an arc in its own plane. Zero: there is none.
[[nodiscard]] Vec3 tangent_at_end(const Motions& motions, std::int64_t motion);
/// Before the first `count` motions are forgotten: what arc_along_tangent() may ask of them. In a plane that the last
/// way stands on, the last one that is not parallel to it has a direction.
void keep_tangents(std::vector<Vec3>& kept, const Motions& motions, std::int64_t count);

}  // namespace clsurf
