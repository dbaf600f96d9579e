#include "identify/parameter_uncertainty.h"

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "identify/rule_list.h"
#include "machine/planning_value.h"

namespace clsurf {
namespace {

std::optional<double> number_in(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

bool has_no_path_limit(const IdentifiedParameter& p, const Machine& machine) {
    return p.axis == "path" && p.name.ends_with("acceleration") && machine.path.max_acceleration >= no_path_limit;
}

}  // namespace

std::vector<ParameterUncertainty> uncertainty_of(const Identification& result) {
    std::vector<ParameterUncertainty> rows;
    for (const IdentifiedParameter& p : result.parameters) {
        if (!is_planning_value(p.name, p.axis) || !(p.value > 0) || has_no_path_limit(p, result.machine)) continue;
        if (p.standard_error)
            rows.push_back({p.name, p.axis, *p.standard_error / p.value});
        else if (p.reached == false)
            rows.push_back({.key = p.name, .of = p.axis, .lower_bound = p.value});
    }
    std::map<std::pair<std::string, std::string>, std::vector<double>> alternatives;
    for (const RuleCandidate& candidate : result.rules) {
        const std::optional<double> value = number_in(candidate.value);
        if (candidate.equal && value && is_planning_value(candidate.rule, candidate.axis))
            alternatives[{candidate.rule, candidate.axis}].push_back(*value);
    }
    for (auto& [name, values] : alternatives) {
        if (values.size() > 1)
            rows.push_back({.key = name.first, .of = name.second, .alternatives = std::move(values)});
    }
    return rows;
}

}  // namespace clsurf
