#include "program/text/functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/units.h"

namespace clsurf {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double sine(double a) { return std::sin(a * rad_per_deg); }
double cosine(double a) { return std::cos(a * rad_per_deg); }
double tangent(double a) { return std::tan(a * rad_per_deg); }
double arc_sine(double v) { return std::asin(v) * deg_per_rad; }
double arc_cosine(double v) { return std::acos(v) * deg_per_rad; }
double round_half_away(double v) { return std::round(v); }

constexpr std::array<FunctionRow, 18> of_all{{
    {"ABS", [](double v) { return std::abs(v); }},
    {"ACOS", arc_cosine},
    {"ASIN", arc_sine},
    {"COS", cosine},
    {"EXP", [](double v) { return std::exp(v); }},
    {"FIX", [](double v) { return std::floor(v); }},
    {"FUP", [](double v) { return std::ceil(v); }},
    {"LN", [](double v) { return std::log(v); }},
    {"ROUND", round_half_away},
    {"SIN", sine},
    {"SQRT", [](double v) { return std::sqrt(v); }},
    {"SQR", [](double v) { return std::sqrt(v); }},
    {"TAN", tangent},
    {"TRUNC", [](double v) { return std::trunc(v); }},
    {"POT", [](double v) { return v * v; }},
    {"ROUNDUP", [](double v) { return std::ceil(v); }},
    {"INT", [](double v) { return std::trunc(v); }},
    {"NOT", [](double v) { return v == 0 ? 1.0 : 0.0; }},
}};

/// Of Heidenhain's formulas alone.
constexpr std::array<FunctionRow, 5> heidenhain_functions{{
    {"SQ", [](double v) { return v * v; }},
    {"NEG", [](double v) { return -v; }},
    {"FRAC", [](double v) { return v - std::trunc(v); }},
    {"SGN", [](double v) { return v > 0   ? 1.0
                                  : v < 0 ? -1.0
                                          : 0.0; }},
    {"LOG", [](double v) { return std::log10(v); }},
}};

/// The digits of v in one base, read as those of another; undefined where a double does not hold them.
double digits_again(double v, std::uint64_t base, double other) {
    constexpr double most = 1e15;
    if (!(v >= 0 && v < most)) return undefined;
    double value = 0;
    double place = 1;
    for (auto rest = static_cast<std::uint64_t>(v); rest > 0; rest /= base, place *= other)
        value += static_cast<double>(rest % base) * place;
    return value;
}
/// Fanuc keeps digits in four bits each: 18 stands for binary 0001'0010. BIN reads it as 12.
double from_decimal_digits(double v) { return digits_again(v, 16, 10); }
double to_decimal_digits(double v) { return digits_again(v, 10, 16); }
constexpr std::array<FunctionRow, 2> fanuc_functions{{{"BIN", from_decimal_digits}, {"BCD", to_decimal_digits}}};

}  // namespace

const FunctionRow* find_function(std::string_view name, DialectId dialect) {
    const auto in = [&](std::span<const FunctionRow> table) {
        const auto found =
            std::find_if(table.begin(), table.end(), [&](const FunctionRow& row) { return row.name == name; });
        return found == table.end() ? nullptr : &*found;
    };
    if (const FunctionRow* found = in(of_all)) return found;
    if (dialect == DialectId::fanuc) return in(fanuc_functions);
    return dialect == DialectId::heidenhain_iso ? in(heidenhain_functions) : nullptr;
}

double call_function(const FunctionRow& function, double argument, DialectId dialect, double least_increment) {
    if (dialect == DialectId::fanuc) {
        if (function.name == "FIX" || function.name == "FUP")
            return std::copysign(function.value(std::abs(argument)), argument);
        if (function.name == "ROUND") return function.value(argument / least_increment) * least_increment;
    }
    return function.value(argument);
}

}  // namespace clsurf
