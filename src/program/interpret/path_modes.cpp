// How corners are passed: exact stops, tolerances.

#include <limits>

#include "program/interpret/interpreter_state.h"

namespace clsurf {

/// `once`: for this block alone.
void Interpreter::set_path_mode(const std::string& name, const std::string& value, const PathMode& mode, bool once) {
    event(name, value);
    program_.events.back().path_mode = mode;
    if (once)
        this_block_.path_mode_returns = true;
    else
        state_.path_mode = mode;
}

/// A G code that sets the mode, with its P and Q.
bool Interpreter::path_mode_word(const CodeWord& word, const PathMode& mode, bool once) {
    set_path_mode("path-mode", code_text(word.code) + words_text(word.block, "PQ"), mode, once);
    // Their words are theirs alone.
    word.block.words.has &= ~(Words::bit('P') | Words::bit('Q'));
    return true;
}

/// G64 P Q: P is the tolerance, as far off as the speed takes without it; blocks merge within Q, without it within P.
bool Interpreter::rounded_corners(const CodeWord& word) {
    const Words& w = word.block.words;
    const double tolerance = w.given('P') ? w.of('P') * state_.unit_mm : 0;
    const double merging = w.given('Q') ? w.of('Q') * state_.unit_mm : tolerance;
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    return path_mode_word(word, {BlockEnd::rounded, tolerance > 0 ? tolerance : unlimited, merging});
}

}  // namespace clsurf
