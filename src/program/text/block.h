#pragma once
// Block: one line of a program as words, in any dialect. Assignments are executed during reading (RS274 and Fanuc:
// after the whole block has been read with the old values).

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "program/text/cursor.h"
#include "program/text/expression.h"
#include "program/text/lexer.h"
#include "program/text/polynomial_word.h"

namespace clsurf {

/// A known word that is not a letter with a value: TRAORI, CYCLE832(0.01), SUPA.
struct Keyword {
    std::string name;       ///< upper case
    std::string arguments;  ///< text between the parentheses
    bool has_arguments = false;
    std::size_t column = 0;
};

struct UnknownWord {
    std::string text;
    std::size_t column = 0;
};

/// A word of several letters: AR=, RPL=, I1=.
struct NamedWord {
    std::string name;
    double value = 0;
    std::size_t column = 0;
    std::optional<bool> increment;  ///< IC(…) true, AC(…) false
};

/// An I, J or K that may occur more than once.
struct CentreWord {
    char letter = 'I';
    double value = 0;
    std::size_t column = 0;
};

struct Block {
    Words words;
    std::uint32_t absolute = 0, incremental = 0;  ///< letters given as AC(…), IC(…)
    /// Letters given as DC(…), ACP(…), ACN(…): absolute modulo 360°, with the direction of rotation of a rotary axis.
    std::uint32_t shortest = 0, positive = 0, negative = 0;
    int extra_turns = 0;                              ///< TURN=
    std::optional<double> polar_radius, polar_angle;  ///< @ and ^ of LinuxCNC, RP= and AP= of Siemens, as written
    bool polar_radius_incremental = false, polar_angle_incremental = false;  ///< IC(…)
    std::vector<NamedWord> named;
    std::vector<CentreWord> centres;  ///< every I, J, K of Fanuc, which macro calls count
    std::vector<PolynomialWord> polynomials;
    std::vector<Keyword> keywords;
    std::vector<UnknownWord> unknown;

    /// A word of several letters, or nullptr.
    [[nodiscard]] const NamedWord* find(std::string_view name) const {
        const auto found =
            std::find_if(named.begin(), named.end(), [&](const NamedWord& word) { return word.name == name; });
        return found == named.end() ? nullptr : &*found;
    }
    [[nodiscard]] std::optional<double> value_of(std::string_view name) const {
        const NamedWord* word = find(name);
        return word == nullptr ? std::nullopt : std::optional(word->value);
    }

    void clear() {
        words.clear();
        absolute = incremental = 0;
        shortest = positive = negative = 0;
        extra_turns = 0;
        polar_radius.reset();
        polar_angle.reset();
        polar_radius_incremental = polar_angle_incremental = false;
        named.clear();
        centres.clear();
        polynomials.clear();
        keywords.clear();
        unknown.clear();
    }
};

/// Reads the words from the cursor to the end of the line. `least_increment`: of lengths, to which Fanuc's ROUND
/// rounds in words of lengths. Throws ReadError.
void read_block(Cursor& cursor, Variables& variables, const TextRules& rules, double least_increment, Block& block);

/// The words of these letters as program text, each after a blank: " P0.01 Q2".
[[nodiscard]] std::string words_text(const Block& block, const char* letters);

/// A code given in tenths: "G54.1".
[[nodiscard]] std::string code_text(int code);

/// A line without its comments, block-delete sign, number and surrounding blanks.
struct Statement {
    std::string text;           ///< same columns as the line: comments are replaced by blanks
    bool deleted = false;       ///< begins with '/'
    bool tape_mark = false;     ///< '%', alone or before a name
    std::string title;          ///< of heidenhain-iso: the text after '%'
    bool open_comment = false;  ///< a '(' that is not closed
};
[[nodiscard]] Statement clean_line(std::string_view line, const TextRules& rules);

}  // namespace clsurf
