#pragma once
// Expressions of NC programs: those of RS274/NGC, Fanuc's custom macro B, Siemens' NC language and
// Heidenhain's formulas. Operators: operators.h; functions: functions.h.

#include <optional>

#include "program/text/cursor.h"
#include "program/text/text_rules.h"
#include "program/text/variables.h"

namespace clsurf {

/// Reads an expression (or a single value) at the cursor and evaluates it. Throws ReadError: a
/// malformed expression, a division by zero, a name that was never set, nesting over 200.
[[nodiscard]] double evaluate(Cursor& cursor, const Variables& variables, const TextRules& rules);

/// The same for Fanuc's macros, in which a variable that was never set is vacant: nullopt. In sums it is 0.
[[nodiscard]] std::optional<double> evaluate_or_vacant(Cursor& cursor, const Variables& variables,
                                                       const TextRules& rules);
/// In a word, ROUND rounds to multiples of `least_increment`, the least input increment of the axes.
[[nodiscard]] std::optional<double> read_or_vacant(Cursor& cursor, const Variables& variables, const TextRules& rules,
                                                   double least_increment = 1);

/// A single value at the cursor: a number, a variable, a bracketed expression, a function, with sign.
[[nodiscard]] double read_value(Cursor& cursor, const Variables& variables, const TextRules& rules);

}  // namespace clsurf
