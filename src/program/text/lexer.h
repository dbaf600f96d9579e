#pragma once
// Lexer: characters of a block → words with their columns. No meaning.
//
// Nearly all blocks of a finishing program are plain: letters followed by decimal numbers. Those are
// read here at memory speed. Other blocks (expressions, assignments, keywords, comments) are left
// to the dialect's block reader, which gets the same text.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace clsurf {

/// The words of one block. A letter's value is in `value`, in any order; G and M words may repeat and are kept as
/// lists.
struct Words {
    static constexpr int most_codes = 24;

    std::array<double, 26> value;          ///< by letter − 'A'; valid only if the bit in `has` is set
    std::array<std::uint16_t, 26> column;  ///< of the letter, from 1 (65535: farther)
    std::uint32_t has = 0;                 ///< bit per letter
    int g_count = 0, m_count = 0;
    std::array<std::int32_t, most_codes> g;  ///< in tenths: G54.1 is 541
    std::array<std::uint16_t, most_codes> g_column;
    std::array<std::int32_t, most_codes> m;

    static constexpr std::uint32_t bit(char letter) { return 1u << (static_cast<unsigned>(letter - 'A') & 31u); }
    static constexpr std::uint32_t xyz = 7u << ('X' - 'A');
    [[nodiscard]] bool given(char letter) const { return (has & bit(letter)) != 0; }
    [[nodiscard]] double of(char letter) const { return value[static_cast<std::size_t>(letter - 'A')]; }
    /// Whether the block has a G code, in tenths.
    [[nodiscard]] bool has_g(int code) const {
        return std::find(g.begin(), g.begin() + g_count, code) != g.begin() + g_count;
    }
    void set(char letter, double number, std::size_t at) {
        const auto k = static_cast<std::size_t>(letter - 'A');
        value[k] = number;
        column[k] = static_cast<std::uint16_t>(at < 65535 ? at : 65535);
        has |= bit(letter);
    }
    void clear() {
        has = 0;
        g_count = 0;
        m_count = 0;
    }
};

/// The axes X, Y, Z that words name, as bits: 1 X, 2 Y, 4 Z.
[[nodiscard]] inline unsigned axes_named(const Words& words) { return words.has >> ('X' - 'A') & 7u; }

/// The result of reading a block.
enum class PlainResult : std::uint8_t {
    plain,    ///< all of it is in the words
    complex,  ///< the dialect must read it
};

/// Reads a block of plain words. `text`: one line without its end.
[[nodiscard]] PlainResult read_plain(std::string_view text, Words& words);

/// A decimal number without exponent at `at` of `text`: [+-]digits[.digits], correctly rounded. Returns the index
/// after it, or `at` if there is none.
[[nodiscard]] std::size_t read_decimal(std::string_view text, std::size_t at, double& value);

/// Letters folded to upper case.
[[nodiscard]] constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; }
[[nodiscard]] constexpr bool is_letter(char c) { return upper(c) >= 'A' && upper(c) <= 'Z'; }
/// A capital letter that names an axis.
[[nodiscard]] constexpr bool is_axis_letter(char c) {
    return std::string_view("XYZABCUVW").find(c) != std::string_view::npos;
}
[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// A name of RS274/NGC, in which blanks and letter case do not matter: "My Name" is "myname".
[[nodiscard]] std::string folded_name(std::string_view text);

/// Appends a G word (value as written, 54.1) to the lists; false: too many, or no such code.
[[nodiscard]] bool add_g(Words& words, double value, std::size_t column);
[[nodiscard]] bool add_m(Words& words, double value);

}  // namespace clsurf
