#pragma once
// The functions of one value in expressions. Angles deg.

#include <string_view>

#include "program/dialects/dialect.h"

namespace clsurf {

struct FunctionRow {
    std::string_view name;
    double (*value)(double);  ///< NaN where it is not defined
};

/// nullptr: the dialect has none of that name (upper case).
[[nodiscard]] const FunctionRow* find_function(std::string_view name, DialectId dialect);

/// As the dialect counts: FIX and FUP of Fanuc by magnitude, its ROUND in multiples of `least_increment`.
[[nodiscard]] double call_function(const FunctionRow& function, double argument, DialectId dialect,
                                   double least_increment);

}  // namespace clsurf
