#pragma once
// Threads: G76 and G33.1 as motions.

#include "core/geometry.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// G76 of LinuxCNC.
void thread_cycle(Interpreter& in, const Block& block);
/// G33.1: to the end with the spindle, and back along the same line.
void tap(Interpreter& in, const Vec3& end, const Vec3& rotary);

}  // namespace clsurf
