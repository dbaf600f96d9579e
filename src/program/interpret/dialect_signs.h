#pragma once
// GuessSigns: evidence for a dialect in a program that does not name it. Part of its rules; dialect_guess.cpp sums
// the weights.

#include <cstdint>
#include <span>
#include <string_view>

namespace clsurf {

/// A word of two letters or more, upper case: alone (TRAORI), or before a number (CYCLE832).
struct WordSign {
    std::string_view word;
    int weight;
};

struct CodeSign {
    int code;  ///< G, in tenths
    int weight;
    std::string_view with;     ///< letters: one of them must be in the block; empty: none is required
    std::string_view without;  ///< letters that must not be in the block
};

/// The ending of a file's name, lower case with its point.
struct EndingSign {
    std::string_view ending;
    int weight;
};

/// Marks of a text that are not words.
enum class Mark : std::uint8_t {
    tape_name,        ///< %_N_
    title_with_unit,  ///< %PART G71 *
    stars,            ///< most blocks end in '*'
    polar_sign,       ///< @5, ^30
    comma_corner,     ///< ,R5 and ,C5
    round_comment,    ///< ( … ) where an expression is impossible
    active_comment,   ///< (DEBUG, …)
    hash_name,        ///< #<name>
    free_assignment,  ///< #1=#2+1 without brackets
    letter_equals,    ///< X=
    q_equals,         ///< Q=
    name_equals,      ///< CR=
    name_colon,       ///< LABEL:
    o_name,           ///< o<name>
    o_statement,      ///< o100 sub
    o_number,         ///< O1000 alone
    jump_to_block,    ///< GOTO 10, GOTO #1
    jump_to_label,    ///< GOTO LABEL
    bracketed_if,     ///< IF [
    open_if,          ///< IF without bracket
    subprogram_m,     ///< M98, M99
    return_m,         ///< M17
    output_m,         ///< M62 … M68
    state_m,          ///< M70 … M73
    blank_in_plane,   ///< G30 G17
    program_begin,    ///< BEGIN PGM
};

struct MarkSign {
    Mark mark;
    int weight;
};

struct GuessSigns {
    std::span<const WordSign> words{};
    std::span<const WordSign> numbered_words{};
    std::span<const CodeSign> codes{};
    std::span<const EndingSign> endings{};
    std::span<const MarkSign> marks{};
};

}  // namespace clsurf
