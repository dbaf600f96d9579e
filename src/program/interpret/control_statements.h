#pragma once
// Control statements: conditions, loops, calls and labels, whatever the dialect writes for them.

#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// True: the statement was one of control.
bool control_statement(Interpreter& in, const Statement& statement);

}  // namespace clsurf
