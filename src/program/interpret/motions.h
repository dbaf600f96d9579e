#pragma once
// Blocks that move: straight lines, arcs, probing, and whatever else the motion mode says.

#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Carries out the motion of a block; none where it names no axis.
void move_axes(Interpreter& in, const Block& block);

}  // namespace clsurf
