#include "program/text/lexer.h"

#include <charconv>
#include <cmath>

#include "core/letter_case.h"

namespace clsurf {
namespace {

constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t exact_integers = std::uint64_t{1} << 53;

/// Numbers that do not fit the fast path: the library's reader, from the first digit on.
std::size_t read_long_decimal(const char* first, const char* last, bool negative, double& value, std::size_t begin) {
    const auto result = std::from_chars(first, last, value, std::chars_format::fixed);
    if (result.ec != std::errc() && result.ec != std::errc::result_out_of_range) return begin;
    if (negative) value = -value;
    return begin + static_cast<std::size_t>(result.ptr - first);
}

}  // namespace

std::size_t read_decimal(std::string_view text, std::size_t at, double& value) {
    const char* const begin = text.data() + at;
    const char* const end = text.data() + text.size();
    const char* p = begin;
    bool negative = false;
    if (p != end && (*p == '-' || *p == '+')) negative = *p++ == '-';
    const char* const digits = p;
    std::uint64_t mantissa = 0;
    while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
    std::ptrdiff_t count = p - digits;
    std::ptrdiff_t decimals = 0;
    if (p != end && *p == '.') {
        const char* const fraction = ++p;
        while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
        decimals = p - fraction;
        count += decimals;
    }
    if (count == 0) return at;
    // A mantissa up to 2^53 divided by up to 10^22 is correctly rounded; 19 digits cannot overflow.
    if (count <= 19 && mantissa <= exact_integers && decimals <= 22) {
        value = static_cast<double>(mantissa) / powers_of_ten[static_cast<std::size_t>(decimals)];
        if (negative) value = -value;
        return at + static_cast<std::size_t>(p - begin);
    }
    const std::size_t first = at + static_cast<std::size_t>(digits - begin);
    const std::size_t next = read_long_decimal(digits, end, negative, value, first);
    return next == first ? at : next;
}

std::string folded_name(std::string_view text) {
    std::string folded;
    for (const char c : text) {
        if (!is_blank(c)) folded += lower_case(c);
    }
    return folded;
}

bool add_g(Words& words, double value, std::size_t column) {
    const double tenths = std::round(value * 10);
    if (words.g_count == Words::most_codes || !(tenths >= 0 && tenths < 1e6) || std::abs(tenths - value * 10) > 1e-3) {
        return false;
    }
    const auto k = static_cast<std::size_t>(words.g_count++);
    words.g[k] = static_cast<std::int32_t>(tenths);
    words.g_column[k] = static_cast<std::uint16_t>(column < 65535 ? column : 65535);
    return true;
}

bool add_m(Words& words, double value) {
    const double code = std::round(value);
    if (words.m_count == Words::most_codes || !(code >= 0 && code < 1e6) || std::abs(code - value) > 1e-3) {
        return false;
    }
    words.m[static_cast<std::size_t>(words.m_count++)] = static_cast<std::int32_t>(code);
    return true;
}

PlainResult read_plain(std::string_view text, Words& words) {
    words.clear();
    std::size_t at = 0;
    const std::size_t size = text.size();
    while (at < size) {
        const char c = text[at];
        if (is_blank(c)) {
            ++at;
            continue;
        }
        const char letter = upper(c);
        // O begins a program or a control word; it is never plain.
        if (letter < 'A' || letter > 'Z' || letter == 'O') return PlainResult::complex;
        const std::size_t column = ++at;
        while (at < size && is_blank(text[at])) ++at;
        double value = 0;
        const std::size_t next = read_decimal(text, at, value);
        if (next == at) return PlainResult::complex;
        at = next;
        if (letter == 'G') {
            if (!add_g(words, value, column)) return PlainResult::complex;
        } else if (letter == 'M') {
            if (!add_m(words, value)) return PlainResult::complex;
        } else {
            if (words.given(letter)) return PlainResult::complex;
            words.set(letter, value, column);
        }
    }
    return PlainResult::plain;
}

}  // namespace clsurf
