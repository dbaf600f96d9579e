#pragma once
// The rules of planners, as candidates of a search.

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "identify/identification.h"
#include "identify/rule_search.h"
#include "machine/machine.h"

namespace clsurf {

inline constexpr double no_path_limit = 1'000'000;  ///< [mm/s²] a path acceleration that limits nothing

[[nodiscard]] bool is_trapezoidal(const Machine& machine);

/// Similar kinds of planner: their other rules are the same.
struct PlannerFamily {
    Rule rule{"planner", "controller", {}, {}};
    std::size_t present =
        std::numeric_limits<std::size_t>::max();  ///< the machine's own kind, if it belongs to the family

    void add(std::string name, bool is_present, std::function<void(Machine&)> apply) {
        if (is_present) present = rule.values.size();
        rule.values.push_back({std::move(name), std::move(apply)});
    }
    [[nodiscard]] bool has_present() const { return present < rule.values.size(); }
};

/// The possible families of a machine; with rotary axes only those that are simulated with them.
[[nodiscard]] std::vector<PlannerFamily> planner_families(const Machine& machine);

/// The rules of a planner of this kind. Each rule is searched with the values found so far for the others. `identified`:
/// limits of the path before any rule.
[[nodiscard]] std::vector<std::function<Rule(const Machine&)>> rules_of(const Machine& machine,
                                                                        const PathLimits& identified);

/// The accelerations of the axes for the trapezoidal planner: every combination, because the slowest axis hides the others.
/// `some_overlap`: blocks may have shown half of a limit even if the planner joins most blocks by arcs.
[[nodiscard]] Rule axis_accelerations_rule(bool some_overlap, const Identification& found);

/// A rule that is not searched, with the reason.
struct OmittedRule {
    const char* name;
    const char* reason;
};
/// The rules that the simulation of this machine does not have.
[[nodiscard]] std::vector<OmittedRule> omitted_rules(const Machine& machine);

}  // namespace clsurf
