#pragma once
// Control statements: conditions, loops, calls and labels of every dialect.

#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Returns whether the statement was one of control.
bool control_statement(Interpreter& in, const Statement& statement);

}  // namespace clsurf
