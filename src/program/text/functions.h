#pragma once
// The functions in expressions. Angles deg.

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace clsurf {

struct FunctionRow {
    std::string_view name;
    double (*value)(double);  ///< NaN if it is not defined
};

/// A function of several values: POW[2,3], MINVAL(R1,R2).
struct ArgumentsRow {
    std::string_view name;
    std::size_t count;
    double (*value)(const std::vector<double>& arguments);
};

/// Of all dialects, or of `own`; nullptr: none of that name (upper case).
[[nodiscard]] const FunctionRow* find_function(std::string_view name, std::span<const FunctionRow> own);

/// `rounds_to_increment`: as in Fanuc, FIX and FUP by magnitude, ROUND to multiples of `least_increment`.
[[nodiscard]] double call_function(const FunctionRow& function, double argument, bool rounds_to_increment,
                                   double least_increment);

}  // namespace clsurf
