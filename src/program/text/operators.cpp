#include "program/text/operators.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "program/text/cursor.h"

namespace clsurf {
namespace {

constexpr double equal_within = 1e-6;  ///< RS274/NGC tests equality with this tolerance

constexpr std::array<OperatorRow, 26> table{{
    {"**", Operator::power, 5, 5, 11, false},
    {"^", Operator::power, 5, 5, 11, false},  // heidenhain-iso
    {"*", Operator::multiply, 4, 4, 9, false},
    {"/", Operator::divide, 4, 4, 9, false},
    {"MOD", Operator::modulo, 4, 4, 9, true},
    {"DIV", Operator::integer_divide, 4, 4, 9, true},
    {"+", Operator::add, 3, 3, 8, false},
    {"-", Operator::subtract, 3, 3, 8, false},
    {"==", Operator::equal, 2, 2, 1, false},
    {"<>", Operator::unequal, 2, 2, 1, false},
    {">=", Operator::greater_equal, 2, 2, 1, false},
    {"<=", Operator::less_equal, 2, 2, 1, false},
    {">", Operator::greater, 2, 2, 1, false},
    {"<", Operator::less, 2, 2, 1, false},
    {"EQ", Operator::equal, 2, 2, 1, true},
    {"NE", Operator::unequal, 2, 2, 1, true},
    {"GT", Operator::greater, 2, 2, 1, true},
    {"GE", Operator::greater_equal, 2, 2, 1, true},
    {"LT", Operator::less, 2, 2, 1, true},
    {"LE", Operator::less_equal, 2, 2, 1, true},
    {"AND", Operator::logical_and, 1, 4, 4, true},
    {"OR", Operator::logical_or, 1, 3, 2, true},
    {"XOR", Operator::logical_xor, 1, 3, 3, true},
    {"B_AND", Operator::bit_and, 1, 4, 7, true},
    {"B_OR", Operator::bit_or, 1, 3, 5, true},
    {"B_XOR", Operator::bit_xor, 1, 3, 6, true},
}};

bool same(double a, double b) { return std::abs(a - b) < equal_within; }

/// RS274 compares order exactly: a loop that counts in tenths ends according to the rounding of its sum.
bool near(double a, double b, const TextRules& rules) { return rules.exact_comparison ? a == b : same(a, b); }

/// Bitwise on whole numbers: B_AND … of Siemens, AND, OR and XOR of Fanuc.
double bitwise(Operator op, double a, double b, std::size_t column) {
    constexpr double most = 9e15;  // whole numbers that a double represents exactly
    if (!(std::abs(a) < most && std::abs(b) < most))
        throw ReadError{"too large for an operation bit by bit", column, {}};
    const std::int64_t x = std::llround(a);
    const std::int64_t y = std::llround(b);
    return static_cast<double>(op == Operator::bit_and ? x & y : op == Operator::bit_or ? x | y : x ^ y);
}

/// Of numbers. The result may be NaN or infinite.
double result_of(Operator op, double a, double b, const TextRules& rules, std::size_t column) {
    switch (op) {
        case Operator::power: return std::pow(a, b);
        case Operator::multiply: return a * b;
        case Operator::divide:
            if (b == 0) throw ReadError{"division by zero", column, {}};
            return a / b;
        case Operator::modulo: {
            if (b == 0) throw ReadError{"division by zero", column, {}};
            const double rest = std::fmod(a, b);
            return rest < 0 && rules.positive_modulo ? rest + std::abs(b) : rest;
        }
        case Operator::integer_divide:
            if (b == 0) throw ReadError{"division by zero", column, {}};
            return std::trunc(a / b);
        case Operator::add: return a + b;
        case Operator::subtract: return a - b;
        case Operator::equal: return same(a, b) ? 1 : 0;
        case Operator::unequal: return same(a, b) ? 0 : 1;
        case Operator::greater: return a > b && !near(a, b, rules) ? 1 : 0;
        case Operator::greater_equal: return a > b || near(a, b, rules) ? 1 : 0;
        case Operator::less: return a < b && !near(a, b, rules) ? 1 : 0;
        case Operator::less_equal: return a < b || near(a, b, rules) ? 1 : 0;
        case Operator::logical_and:
            if (rules.bitwise_logic) return bitwise(Operator::bit_and, a, b, column);
            return a != 0 && b != 0 ? 1 : 0;
        case Operator::logical_or:
            if (rules.bitwise_logic) return bitwise(Operator::bit_or, a, b, column);
            return a != 0 || b != 0 ? 1 : 0;
        case Operator::logical_xor:
            if (rules.bitwise_logic) return bitwise(Operator::bit_xor, a, b, column);
            return (a != 0) != (b != 0) ? 1 : 0;
        case Operator::bit_and:
        case Operator::bit_or:
        case Operator::bit_xor: return bitwise(op, a, b, column);
    }
    return 0;
}

}  // namespace

std::span<const OperatorRow> operator_table() { return table; }

double apply_operator(Operator op, double a, double b, const TextRules& rules, std::size_t column) {
    if (std::isnan(a) || std::isnan(b)) {
        // A vacant variable equals only another vacant one; in other operations it is 0.
        const bool both = std::isnan(a) && std::isnan(b);
        if (op == Operator::equal) return both ? 1 : 0;
        if (op == Operator::unequal) return both ? 0 : 1;
        a = std::isnan(a) ? 0 : a;
        b = std::isnan(b) ? 0 : b;
    }
    const double result = result_of(op, a, b, rules, column);
    // A NaN would be a vacant variable from here on.
    if (!std::isfinite(result)) throw ReadError{"the result of the operation is not defined, or too large", column, {}};
    return result;
}

}  // namespace clsurf
