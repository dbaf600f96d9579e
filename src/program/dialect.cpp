#include "program/dialect.h"

#include <algorithm>
#include <array>

#include "program/lexer.h"

namespace clsurf {
namespace {

constexpr std::array<Dialect, 4> table{{
    {DialectId::fanuc, "fanuc", "Fanuc, HNC and most others: G-code with custom macro B"},
    {DialectId::siemens, "siemens", "SINUMERIK: X=AC(…), TRAORI, CYCLE832, R parameters"},
    {DialectId::linuxcnc, "linuxcnc", "LinuxCNC: RS274/NGC with O-words and named parameters"},
    {DialectId::heidenhain_iso, "heidenhain-iso", "Heidenhain DIN/ISO: blocks ending in *, Q parameters"},
}};

constexpr std::size_t looked_at = 200'000;  ///< bytes of the text

struct Sign {
    std::string_view text;  ///< upper case
    DialectId dialect;
    int weight;
};

/// Words that one dialect writes and the others do not.
constexpr auto signs = std::to_array<Sign>({
    {"TRAORI", DialectId::siemens, 10},   {"TRAFOOF", DialectId::siemens, 10},  {"CYCLE8", DialectId::siemens, 10},
    {"SUPA", DialectId::siemens, 6},      {"DEF REAL", DialectId::siemens, 10}, {"DEF INT", DialectId::siemens, 10},
    {"MCALL", DialectId::siemens, 10},    {"MSG(\"", DialectId::siemens, 6},    {"=AC(", DialectId::siemens, 10},
    {"=IC(", DialectId::siemens, 10},     {"FFWON", DialectId::siemens, 8},     {"SOFT\n", DialectId::siemens, 4},
    {"G641", DialectId::siemens, 8},      {"G642", DialectId::siemens, 8},      {"TURN=", DialectId::siemens, 8},
    {"CR=", DialectId::siemens, 6},       {"GOTOF", DialectId::siemens, 8},     {"ENDPROC", DialectId::siemens, 8},
    {"COMPCAD", DialectId::siemens, 8},   {"T=\"", DialectId::siemens, 8},      {"ENDSUB", DialectId::linuxcnc, 10},
    {"ENDWHILE", DialectId::linuxcnc, 5}, {"#<", DialectId::linuxcnc, 10},      {"G64 P", DialectId::linuxcnc, 6},
    {"G61.1", DialectId::linuxcnc, 5},    {"G90.1", DialectId::linuxcnc, 3},    {"G05 P", DialectId::fanuc, 8},
    {"G05P", DialectId::fanuc, 8},        {"G5.1 Q", DialectId::fanuc, 8},      {"G05.1", DialectId::fanuc, 8},
    {"G43.4", DialectId::fanuc, 6},
});

/// Whether a sign begins with a character.
constexpr std::array<bool, 256> begins_sign = [] {
    std::array<bool, 256> begins{};
    for (const Sign& sign : signs) {
        const char first = sign.text.front();
        begins[static_cast<unsigned char>(first)] = true;
        if (first >= 'A' && first <= 'Z') begins[static_cast<unsigned char>(first - 'A' + 'a')] = true;
    }
    return begins;
}();

bool folded_at(std::string_view text, std::size_t at, std::string_view word) {
    if (text.size() - at < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (upper(text[at + i]) != word[i]) return false;
    }
    return true;
}

}  // namespace

std::span<const Dialect> dialects() { return table; }

const Dialect* find_dialect(std::string_view name) {
    const auto* found = std::find_if(table.begin(), table.end(), [&](const Dialect& d) { return d.name == name; });
    return found == table.end() ? nullptr : found;
}

const Dialect& detect_dialect(std::string_view text) {
    text = text.substr(0, looked_at);
    std::array<int, table.size()> score{};
    std::size_t stars = 0;
    std::size_t lines = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '\n') {
            ++lines;
            std::size_t last = at;
            while (last > 0 && is_blank(text[last - 1])) --last;
            if (last > 0 && text[last - 1] == '*') ++stars;
            continue;
        }
        if (begins_sign[static_cast<unsigned char>(c)]) {
            for (const Sign& sign : signs) {
                if (folded_at(text, at, sign.text)) score[static_cast<std::size_t>(sign.dialect)] += sign.weight;
            }
        }
        // "o100 sub": a control word of LinuxCNC; "O1000" alone is a program number.
        const bool line_start = at == 0 || text[at - 1] == '\n';
        if (line_start && upper(c) == 'O') {
            const std::size_t end = std::min(text.size(), text.find('\n', at));
            for (const std::string_view word : {" SUB", " CALL", " IF", " WHILE", " REPEAT", " DO"}) {
                for (std::size_t k = at; k < end; ++k) {
                    if (folded_at(text, k, word)) score[static_cast<std::size_t>(DialectId::linuxcnc)] += 10;
                }
            }
        }
    }
    if (lines > 2 && stars * 2 > lines) return table[static_cast<std::size_t>(DialectId::heidenhain_iso)];
    const auto* best = std::max_element(score.begin(), score.end());
    return *best > 0 ? table[static_cast<std::size_t>(best - score.begin())]
                     : table[static_cast<std::size_t>(DialectId::fanuc)];
}

}  // namespace clsurf
