#pragma once
// ParameterRules: which parameters runs may have, and of what kind their values are.

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
    std::optional<double> low, high;       ///< of a number, both ends included
    std::vector<std::string> values = {};  ///< of a text: all that are allowed; empty: any
    bool required = false;
    friend bool operator==(const ParameterRule&, const ParameterRule&) = default;
};

struct ParameterRules {
    std::vector<ParameterRule> rules;  ///< empty: any parameter is allowed

    /// The parameters as they are kept: a number without its unit. Throws UsageError: a name that is not known or that
    /// cannot be one, a value of another kind, out of its range or in another unit, a required one that is missing.
    /// With `all` false others may follow: nothing is missing yet.
    [[nodiscard]] std::vector<RunParameter> checked(std::vector<RunParameter> parameters, bool all = true) const;
    /// Numbers with their unit, as they are read again: "0.05 mm". Domain: checked ones.
    [[nodiscard]] std::vector<RunParameter> with_units(std::vector<RunParameter> parameters) const;
};

/// The name of a parameter of which two sets have different rules, or which only one of them has; empty: they agree.
[[nodiscard]] std::string first_difference(const ParameterRules& a, const ParameterRules& b);

/// "tool=D6R3". Throws UsageError: no "=", no name, no value.
[[nodiscard]] RunParameter parse_parameter(const std::string& text);

}  // namespace clsurf
