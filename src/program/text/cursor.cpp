#include "program/text/cursor.h"

namespace clsurf {

bool Cursor::take_word(std::string_view word) {
    skip_blanks();
    if (text.size() - at < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (upper(text[at + i]) != word[i]) return false;
    }
    const std::size_t after = at + word.size();
    if (after < text.size() && (is_letter(text[after]) || is_digit(text[after]) || text[after] == '_')) {
        return false;
    }
    at = after;
    return true;
}

std::string Cursor::identifier() {
    skip_blanks();
    std::string name;
    for (std::size_t i = at; i < text.size(); ++i) {
        const char c = text[i];
        if (!is_letter(c) && !is_digit(c) && c != '_' && c != '$') break;
        name += upper(c);
    }
    if (!name.empty() && is_digit(name.front())) name.clear();
    return name;
}

}  // namespace clsurf
