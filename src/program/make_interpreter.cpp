#include "program/make_interpreter.h"

#include <utility>

#include "program/dialects/dialect_guess.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {

std::unique_ptr<Interpreter> make_interpreter(SourceText text, const InterpreterOptions& options) {
    if (options.dialect != nullptr) return std::make_unique<Interpreter>(std::move(text), options);
    DialectGuess guess = guess_dialect(text.text(), text.name());
    InterpreterOptions guessed = options;
    guessed.dialect = guess.dialect;
    return std::make_unique<Interpreter>(std::move(text), guessed, std::move(guess.reason));
}

Program parse_program(SourceText text, const InterpreterOptions& options) {
    return make_interpreter(std::move(text), options)->run();
}

}  // namespace clsurf
