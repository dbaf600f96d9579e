#pragma once
// Canned cycles G73 … G89 as motions.

#include "core/geometry.h"
#include "program/motion.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// A block while a canned cycle is active: as many holes as it programs.
void drilling_cycle(Interpreter& in, const Block& block);
/// Moves along the drilling axis to a height in the program's coordinates.
void go_to_level(Interpreter& in, MotionKind kind, double height, const Vec3& rotary);
/// Moves at rapid, in the program's coordinates.
void step_aside(Interpreter& in, const Vec3& by, const Vec3& rotary);

}  // namespace clsurf
