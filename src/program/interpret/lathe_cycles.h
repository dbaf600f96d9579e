#pragma once
// Turning cycles of LinuxCNC: G70 … G72.

#include <cstddef>

#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// G70 finishes, G71 and G72 rough the profile of a subprogram (Q).
void lathe_cycle(Interpreter& in, int code, const Block& words, std::size_t column);

}  // namespace clsurf
