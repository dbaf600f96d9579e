#pragma once
// Blocks that move: straight lines, arcs, probing, and the other motion modes.

#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Executes the motion of a block; none if it names no axis.
void move_axes(Interpreter& in, const Block& block);

}  // namespace clsurf
