#pragma once
// ParameterRules: the allowed parameters of runs, and the kinds of their values.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "history/run_record.h"

namespace clsurf {

enum class ParameterKind : std::uint8_t { text, number, integer };
[[nodiscard]] std::string_view name_of(ParameterKind kind);  ///< "text"

struct ParameterRule {
    std::string name;
    ParameterKind kind = ParameterKind::text;
    std::string unit = {};                 ///< of a number, "mm"; empty: none
    std::optional<double> low, high;       ///< bounds of a number, inclusive
    std::vector<std::string> values = {};  ///< allowed values of a text; empty: any value
    bool required = false;
    friend bool operator==(const ParameterRule&, const ParameterRule&) = default;
};

struct ParameterRules {
    std::vector<ParameterRule> rules;  ///< empty: any parameter is allowed

    /// The parameters as they are stored: numbers without units. Throws UsageError: an unknown or invalid name, a
    /// value of another kind, out of its range or in another unit, a missing required parameter. With `all` false more
    /// parameters may follow, so a missing one is no error.
    [[nodiscard]] std::vector<RunParameter> checked(std::vector<RunParameter> parameters, bool all = true) const;
    /// Numbers with their unit, in input form: "0.05 mm". Domain: checked parameters.
    [[nodiscard]] std::vector<RunParameter> with_units(std::vector<RunParameter> parameters) const;
};

/// The name of a parameter with different rules in two sets, or with a rule in only one of them; empty: they agree.
[[nodiscard]] std::string first_difference(const ParameterRules& a, const ParameterRules& b);

/// "tool=D6R3". Throws UsageError: no "=", no name, no value.
[[nodiscard]] RunParameter parse_parameter(const std::string& text);

}  // namespace clsurf
