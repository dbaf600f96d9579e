#pragma once
// The interpreter of a text. For the readers of programs in this folder.

#include <memory>

#include "program/interpreter.h"

namespace clsurf {

class Interpreter;

/// In the dialect of the options, or in the detected one. Throws InputError.
[[nodiscard]] std::unique_ptr<Interpreter> make_interpreter(SourceText text, const InterpreterOptions& options);

}  // namespace clsurf
