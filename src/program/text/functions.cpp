#include "program/text/functions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"

namespace clsurf {
namespace {

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

}  // namespace

const FunctionRow* find_function(std::string_view name, std::span<const FunctionRow> own) {
    const auto in = [&](std::span<const FunctionRow> table) {
        const auto found =
            std::find_if(table.begin(), table.end(), [&](const FunctionRow& row) { return row.name == name; });
        return found == table.end() ? nullptr : &*found;
    };
    const FunctionRow* found = in(of_all);
    return found != nullptr ? found : in(own);
}

double call_function(const FunctionRow& function, double argument, bool rounds_to_increment, double least_increment) {
    if (rounds_to_increment) {
        if (function.name == "FIX" || function.name == "FUP")
            return std::copysign(function.value(std::abs(argument)), argument);
        if (function.name == "ROUND") return function.value(argument / least_increment) * least_increment;
    }
    return function.value(argument);
}

}  // namespace clsurf
