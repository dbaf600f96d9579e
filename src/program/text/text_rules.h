#pragma once
// TextRules: how a dialect writes lines, words and expressions. Part of its DialectRules; the default is plain G-code
// with comments in parentheses. Each rule stands alone, so that a dialect combines them as its control does.

#include <cstdint>
#include <span>
#include <string_view>

#include "program/text/functions.h"

namespace clsurf {

struct Control;

/// How tightly operators bind: a column of the table in operators.cpp.
enum class OperatorRanks : std::uint8_t { rs274, fanuc, siemens };

/// What a block is made of.
enum class WordStyle : std::uint8_t {
    letters,  ///< a letter and its value: X10, X[#1+2]
    names,    ///< also names with '=' or arguments: CR=10, CYCLE832(0.01); parentheses are those of expressions
};

/// What repaired sections are written as (repair/spline_lines.h).
enum class SplineForm : std::uint8_t {
    none,
    cubic_plane,  ///< G5: a Bézier curve of X and Y, a block each span
    knotted,      ///< G06.2: a NURBS with its knots
    basis,        ///< BSPLINE: a B-spline with the lengths of its spans
    polynomial,   ///< SPL: a cubic in each axis, a block each span
};

struct TextRules {
    // Lines.
    bool semicolon_comments = false;   ///< the usual comment is "; …", not "( … )"
    bool round_comments = true;        ///< ( … ) is a comment
    bool formulas = false;             ///< after '=' parentheses and '*' belong to the expression
    bool star_ends_block = false;      ///< '*' ends a block, '~' continues it
    bool blanks_in_numbers = false;    ///< "1 0 . 5" is 10.5
    bool skip_levels = true;           ///< /1 … /9
    bool named_titles = false;         ///< "%NAME G71" begins and ends a program
    bool block_numbers = false;        ///< a number without N begins a line
    std::string_view straight_word{};  ///< what begins every straight line, as L; empty: G1, which stays in force
    std::string_view first_block{};    ///< how the first block of a program begins, after its number
    double inch_feed = 1;              ///< inches that F counts in an inch program

    SplineForm splines = SplineForm::none;  ///< of repaired sections

    // Words.
    WordStyle words = WordStyle::letters;
    bool polar_signs = false;           ///< @ radius, ^ angle
    bool repeated_words = true;         ///< the last one counts; false: an error
    bool counts_centres = false;        ///< every I, J, K is kept for macro calls
    bool assigns_expressions = true;    ///< #1=#2+1; false: a value, #1=[#2+1]
    bool functions_after_words = true;  ///< Xsin[30]
    bool q_words = false;               ///< X+Q5, Q5 = …: Q is a variable wherever a value may stand

    // Expressions.
    OperatorRanks ranks = OperatorRanks::rs274;
    bool vacant_variables = false;                 ///< a variable that was never set is no number, not 0
    bool caret_power = false;                      ///< ^
    bool round_brackets = false;                   ///< ( … ) groups, as [ … ] does
    bool divided_arc_tangent = false;              ///< ATAN[a]/[b] only
    bool exact_comparison = false;                 ///< < and > without a tolerance
    bool positive_modulo = false;                  ///< MOD is never negative
    bool bitwise_logic = false;                    ///< AND, OR, XOR work bit by bit
    bool rounds_to_increment = false;              ///< ROUND in a word; FIX and FUP by magnitude
    double numbered_parameters = 0;                ///< EXISTS[#n] is true below this number
    std::string_view numbered_names{};             ///< letters of numbered variables: R5, Q5
    std::span<const FunctionRow> functions{};      ///< besides those of all dialects
    std::span<const ArgumentsRow> of_arguments{};  ///< functions of several values

    /// What control statement a cleaned line is, if any. Throws ReadError. nullptr: the dialect has none.
    Control (*control)(std::string_view statement) = nullptr;
};

}  // namespace clsurf
