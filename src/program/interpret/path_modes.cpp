// The modes of corners: exact stops, tolerances.

#include "program/interpret/path_modes.h"

#include <limits>

#include "program/interpret/interpreter_state.h"

namespace clsurf {

void set_path_mode(Interpreter& in, const std::string& name, const std::string& value, const PathMode& mode,
                   bool once) {
    in.event(name, value, mode);
    if (once)
        in.this_block_.path_mode_returns = true;
    else
        in.state_.path_mode = mode;
}

bool path_mode_word(Interpreter& in, const CodeWord& word, const PathMode& mode, bool once) {
    set_path_mode(in, "path-mode", code_text(word.code) + words_text(word.block, "PQ"), mode, once);
    // P and Q belong to this code only.
    word.block.words.has &= ~(Words::bit('P') | Words::bit('Q'));
    return true;
}

bool rounded_corners(Interpreter& in, const CodeWord& word) {
    const Words& w = word.block.words;
    const double tolerance = w.given('P') ? w.of('P') * in.state_.unit_mm : 0;
    const double merging = w.given('Q') ? w.of('Q') * in.state_.unit_mm : tolerance;
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    return path_mode_word(in, word, {BlockEnd::rounded, tolerance > 0 ? tolerance : unlimited, merging});
}

}  // namespace clsurf
