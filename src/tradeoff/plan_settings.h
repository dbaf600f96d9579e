#pragma once
// PlanSettings: the shares of a machine's limits that a plan uses. On every control they can be set: by the dynamics of its
// finishing mode, by its feed override, or by the F words of the program.

#include <string>

#include "machine/machine.h"

namespace clsurf {

/// Shares of the values in the machine file, more than 0 and at most 1.
struct PlanSettings {
    double jerk = 1;          ///< of every jerk limit
    double acceleration = 1;  ///< of every acceleration limit: tangential, normal and of the axes
    double feed = 1;          ///< of the programmed feeds, as feed override
    bool intervals = false;   ///< lowers feeds to the speeds of constant-speed intervals

    friend bool operator==(const PlanSettings&, const PlanSettings&) = default;
};

/// "jerk 70 %, feed 85 %, intervals"; "as the machine file" if all shares are 1.
[[nodiscard]] std::string text_of(const PlanSettings& settings);

/// Whether a lower share of the jerk has an effect: the planner limits a jerk.
[[nodiscard]] bool limits_jerk(const Machine& machine);

/// The machine with these settings, and with their text appended to its name. Its fidelity and the uncertainty of its
/// values belong to other settings and are removed.
[[nodiscard]] Machine with_settings(Machine machine, const PlanSettings& settings);

}  // namespace clsurf
