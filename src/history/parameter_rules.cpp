#include "history/parameter_rules.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/spelling.h"

namespace clsurf {
namespace {

[[noreturn]] void refuse(const RunParameter& parameter, const std::string& why, const std::string& hint = {}) {
    throw UsageError(fmt::format("--param: {}={} {}", parameter.name, parameter.value, why), hint);
}

/// A number with or without its unit: the number of bytes that it takes, 0 if there is none.
std::size_t read_number(std::string_view text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && std::isfinite(value) ? static_cast<std::size_t>(end - text.data()) : 0;
}

std::string range_text(const ParameterRule& rule) {
    const std::string unit = rule.unit.empty() ? "" : " " + rule.unit;
    if (rule.low && rule.high) return fmt::format("{:g} … {:g}{}", *rule.low, *rule.high, unit);
    return rule.low ? fmt::format("at least {:g}{}", *rule.low, unit) : fmt::format("at most {:g}{}", *rule.high, unit);
}

void check_number(const ParameterRule& rule, RunParameter& parameter) {
    double value = 0;
    const std::size_t size = read_number(parameter.value, value);
    std::string rest = parameter.value.substr(size);
    rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
    if (size == 0)
        refuse(parameter,
               fmt::format("is not {}", rule.kind == ParameterKind::integer ? "a whole number" : "a number"));
    if (!rest.empty() && rest != rule.unit)
        refuse(parameter, rule.unit.empty() ? fmt::format("has a unit, '{}', but none is expected", rest)
                                            : fmt::format("is in '{}', expected {}", rest, rule.unit));
    parameter.value.resize(size);
    if (rule.kind == ParameterKind::integer && value != std::floor(value)) refuse(parameter, "is not a whole number");
    if ((rule.low && value < *rule.low) || (rule.high && value > *rule.high))
        refuse(parameter, "is out of range: " + range_text(rule));
}

void check_text(const ParameterRule& rule, const RunParameter& parameter) {
    if (rule.values.empty() || std::ranges::find(rule.values, parameter.value) != rule.values.end()) return;
    std::string list;
    for (const std::string& value : rule.values) list += (list.empty() ? "" : ", ") + value;
    const std::vector<std::string_view> known(rule.values.begin(), rule.values.end());
    refuse(parameter, "is not one of " + list, did_you_mean(parameter.value, known));
}

bool may_be_a_name(const std::string& name) {
    const auto letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
    return !name.empty() && letter(static_cast<unsigned char>(name[0])) &&
           std::ranges::all_of(
               name, [&](unsigned char c) { return letter(c) || std::isdigit(c) != 0 || c == '-' || c == '.'; });
}

}  // namespace

std::string_view name_of(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::text: return "text";
        case ParameterKind::number: return "number";
        case ParameterKind::integer: return "integer";
    }
    return {};
}

std::vector<RunParameter> ParameterRules::checked(std::vector<RunParameter> parameters, bool all) const {
    sort_parameters(parameters);
    if (rules.empty()) return parameters;
    std::vector<std::string_view> known;
    for (const ParameterRule& rule : rules) known.push_back(rule.name);
    for (RunParameter& parameter : parameters) {
        const auto rule = std::ranges::find(rules, parameter.name, &ParameterRule::name);
        if (rule == rules.end())
            throw UsageError(fmt::format("--param: there is no parameter '{}'", parameter.name),
                             did_you_mean(parameter.name, known));
        rule->kind == ParameterKind::text ? check_text(*rule, parameter) : check_number(*rule, parameter);
    }
    for (const ParameterRule& rule : rules) {
        if (all && rule.required && std::ranges::find(parameters, rule.name, &RunParameter::name) == parameters.end())
            throw UsageError(fmt::format("the parameter '{}' is required", rule.name),
                             fmt::format("--param {}=…", rule.name));
    }
    return parameters;
}

std::vector<RunParameter> ParameterRules::with_units(std::vector<RunParameter> parameters) const {
    for (RunParameter& parameter : parameters) {
        const auto rule = std::ranges::find(rules, parameter.name, &ParameterRule::name);
        if (rule != rules.end() && !rule->unit.empty()) parameter.value += " " + rule->unit;
    }
    return parameters;
}

std::string first_difference(const ParameterRules& a, const ParameterRules& b) {
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (const ParameterRule& rule : one->rules) {
            const auto same = std::ranges::find(other->rules, rule.name, &ParameterRule::name);
            if (same == other->rules.end() || !(*same == rule)) return rule.name;
        }
    }
    return {};
}

RunParameter parse_parameter(const std::string& text) {
    const std::size_t equals = text.find('=');
    RunParameter parameter{text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1)};
    if (equals == std::string::npos || parameter.value.empty())
        throw UsageError(fmt::format("--param: '{}' is not NAME=VALUE", text), "for example --param tool=D6R3");
    if (!may_be_a_name(parameter.name))
        throw UsageError(fmt::format("--param: '{}' cannot be the name of a parameter", parameter.name),
                         "a letter, then letters, digits, '_', '-' and '.'");
    return parameter;
}

}  // namespace clsurf
