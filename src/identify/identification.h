#pragma once
// Identification: what recorded runs show of a machine, value by value.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.h"
#include "identify/run_fidelity.h"
#include "machine/machine.h"

namespace clsurf {

/// A value that the runs determine.
struct IdentifiedParameter {
    std::string name;                      ///< the key of the machine file; "lag" and "offset" have none
    std::string axis;                      ///< "x" …, "path", "controller"
    double value = 0;                      ///< in `unit`
    std::string unit;                      ///< empty: a ratio
    std::optional<double> standard_error;  ///< in `unit`
    std::optional<bool> reached;           ///< for limits only; false: a lower bound
    std::string note;                      ///< evidence, a few words; may be empty
    double shown = 0;  ///< for lower bounds: the value including what rounding may have added, in `unit`
};

/// A value that the runs do not determine.
struct UnidentifiedParameter {
    std::string name, axis;
    std::string reason;
};

/// A possible value of a planner rule, simulated and compared with the runs.
struct RuleCandidate {
    std::string rule;        ///< "planner", "arc_blends", "lookahead_blocks" …
    std::string value;       ///< as a machine file has it
    double score = 0;        ///< information criterion of the speed along the path; the lowest explains the runs best
    double speed_error = 0;  ///< [mm/s] mean |difference| of the speed
    bool chosen = false;
    bool equal = false;  ///< explains the runs about as well as the best one
    std::string axis{};  ///< "controller", "path", "kinematics"
};

struct Identification {
    Machine machine;  ///< the values known before, with the identified values
    std::vector<IdentifiedParameter> parameters;
    std::vector<UnidentifiedParameter> unidentified;
    std::vector<RuleCandidate> rules;
    std::vector<RunFidelity> fit;               ///< of the runs, each simulated with `machine`
    std::vector<RunFidelity> tests;             ///< of runs that the fit does not use
    std::vector<RunFidelity> cross_validation;  ///< of the runs, each simulated with the values of the others
    std::vector<std::string> runs;              ///< the logs, as the user named them
    Diagnostics diagnostics;

    [[nodiscard]] const IdentifiedParameter* find(std::string_view name, std::string_view axis) const;
    [[nodiscard]] const UnidentifiedParameter* find_missing(std::string_view name, std::string_view axis) const;
};

/// Rounds a value to the digits that its standard error supports, two of which are uncertain.
[[nodiscard]] double rounded_to(double value, double standard_error);

}  // namespace clsurf
