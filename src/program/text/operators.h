#pragma once
// The operators of expressions: their spelling, precedence and result.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "program/text/text_rules.h"

namespace clsurf {

enum class Operator : std::uint8_t {
    power,
    multiply,
    divide,
    modulo,
    integer_divide,
    add,
    subtract,
    equal,
    unequal,
    greater,
    greater_equal,
    less,
    less_equal,
    logical_and,
    logical_or,
    logical_xor,
    bit_and,
    bit_or,
    bit_xor,
};

struct OperatorRow {
    std::string_view text;
    Operator op;
    int rank;     ///< higher binds tighter: of RS274 and Heidenhain
    int fanuc;    ///< AND binds as tightly as *, OR and XOR as +
    int siemens;  ///< comparisons come last (Job Planning, "Priority of the operations")
    bool word;

    [[nodiscard]] int rank_in(OperatorRanks ranks) const {
        return ranks == OperatorRanks::fanuc ? fanuc : ranks == OperatorRanks::siemens ? siemens : rank;
    }
};

/// Longer operators come before their own prefixes.
[[nodiscard]] std::span<const OperatorRow> operator_table();

/// NaN is a vacant variable of Fanuc. `column`: of the operator, for the ReadError on a division by zero or on a
/// number too large for bitwise logic.
[[nodiscard]] double apply_operator(Operator op, double a, double b, const TextRules& rules, std::size_t column);

}  // namespace clsurf
