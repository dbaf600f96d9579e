#pragma once
// Cursor: the position of a reader in a line. ReadError: an error at that position; the interpreter adds file and
// line and throws InputError.

#include <cstddef>
#include <string>
#include <string_view>

#include "program/text/lexer.h"

namespace clsurf {

/// An error in a line and its byte (from 1). Readers of expressions and blocks throw it; it becomes an InputError
/// where file and line are known.
struct ReadError {
    std::string what;
    std::size_t column = 0;
    std::string hint;
};

struct Cursor {
    std::string_view text;
    std::size_t at = 0;

    void skip_blanks() {
        while (at < text.size() && is_blank(text[at])) ++at;
    }
    [[nodiscard]] bool done() const { return at >= text.size(); }
    /// The next character that is not a blank; NUL at the end.
    [[nodiscard]] char peek() {
        skip_blanks();
        return at < text.size() ? text[at] : '\0';
    }
    [[nodiscard]] std::size_t column() const { return at + 1; }
    /// Reads the character if it is the next.
    bool take(char c) {
        if (peek() != c) return false;
        ++at;
        return true;
    }
    /// Reads a word of letters if it is the next (case folded) and no letter or digit follows.
    bool take_word(std::string_view word);
    /// The identifier here (letters, digits, underscores), upper case; empty: none. Does not move.
    [[nodiscard]] std::string identifier();
};

}  // namespace clsurf
