#pragma once
// TextRules: the syntax of a dialect's lines, words and expressions. Part of its DialectRules; the default is plain
// G-code with comments in parentheses. The rules are independent, so that a dialect can combine them as its control
// does.

#include <cstdint>
#include <span>
#include <string_view>

#include "program/text/functions.h"

namespace clsurf {

struct Control;

/// Precedence of operators: a column of the table in operators.cpp.
enum class OperatorRanks : std::uint8_t { rs274, fanuc, siemens };

/// The parts of a block.
enum class WordStyle : std::uint8_t {
    letters,  ///< a letter and its value: X10, X[#1+2]
    names,    ///< also names with '=' or arguments: CR=10, CYCLE832(0.01); parentheses are those of expressions
};

/// The form of repaired sections (repair/spline_lines.h).
enum class SplineForm : std::uint8_t {
    none,
    cubic_plane,  ///< G5: a Bézier curve of X and Y, one block per span
    knotted,      ///< G06.2: a NURBS with its knots
    basis,        ///< BSPLINE: a B-spline with the lengths of its spans
    polynomial,   ///< SPL: a cubic in each axis, one block per span
};

struct TextRules {
    // Lines.
    bool semicolon_comments = false;  ///< the usual comment is "; …", not "( … )"
    bool round_comments = true;       ///< ( … ) is a comment
    bool formulas = false;            ///< after '=' parentheses and '*' belong to the expression
    bool star_ends_block = false;     ///< '*' ends a block, '~' continues it
    bool blanks_in_numbers = false;   ///< "1 0 . 5" is 10.5
    bool skip_levels = true;          ///< /1 … /9
    bool named_titles = false;        ///< "%NAME G71" is at the beginning and end of a program
    bool block_numbers = false;       ///< a number without N begins a line
    std::string_view
        straight_word{};  ///< the first word of every straight line, for example L; empty: G1, which is modal
    std::string_view first_block{};  ///< the first block of a program, after its number
    double inch_feed = 1;            ///< length that F counts in an inch program [inch]

    SplineForm splines = SplineForm::none;  ///< form of the splines of repaired sections

    // Words.
    WordStyle words = WordStyle::letters;
    bool polar_signs = false;           ///< @ radius, ^ angle
    bool repeated_words = true;         ///< the last one counts; false: an error
    bool counts_centres = false;        ///< every I, J, K is kept for macro calls
    bool assigns_expressions = true;    ///< #1=#2+1; false: a value, #1=[#2+1]
    bool functions_after_words = true;  ///< Xsin[30]
    bool q_words = false;               ///< X+Q5, Q5 = …: Q is a variable wherever a value is allowed

    // Expressions.
    OperatorRanks ranks = OperatorRanks::rs274;
    bool vacant_variables = false;                 ///< a variable that was never set is vacant, not 0
    bool caret_power = false;                      ///< ^
    bool round_brackets = false;                   ///< ( … ) groups, like [ … ]
    bool divided_arc_tangent = false;              ///< ATAN[a]/[b] only
    bool exact_comparison = false;                 ///< < and > without a tolerance
    bool positive_modulo = false;                  ///< MOD is never negative
    bool bitwise_logic = false;                    ///< AND, OR, XOR are bitwise
    bool rounds_to_increment = false;              ///< ROUND in a word; FIX and FUP by magnitude
    double numbered_parameters = 0;                ///< EXISTS[#n] is true below this number
    std::string_view numbered_names{};             ///< letters of numbered variables: R5, Q5
    std::span<const FunctionRow> functions{};      ///< besides those of all dialects
    std::span<const ArgumentsRow> of_arguments{};  ///< functions of several values

    /// The control statement of a cleaned line, if any. Throws ReadError. nullptr: the dialect has none.
    Control (*control)(std::string_view statement) = nullptr;
};

}  // namespace clsurf
