#pragma once
// PlanSettings: how much of a machine's limits a plan uses. Every control can be set so: by the dynamics of its finishing mode, by
// its feed override, or by the F words of the program.

#include <string>

#include "machine/machine.h"

namespace clsurf {

/// Shares of what the machine file says, more than 0 and at most 1.
struct PlanSettings {
    double jerk = 1;          ///< of every jerk limit
    double acceleration = 1;  ///< of every acceleration limit, along the path, across it and of the axes
    double feed = 1;          ///< of the programmed feeds, by the feed override
    bool intervals = false;   ///< feeds are those of constant-speed intervals where these are lower

    friend bool operator==(const PlanSettings&, const PlanSettings&) = default;
};

/// "jerk 70 %, feed 85 %, intervals"; "as the machine file" where all is used.
[[nodiscard]] std::string text_of(const PlanSettings& settings);

/// Whether a lower share of the jerk changes anything: the planner limits some jerk.
[[nodiscard]] bool limits_jerk(const Machine& machine);

/// The machine with these settings, and with their text behind its name. Its fidelity and the uncertainty of its values are those
/// of other settings, and left out.
[[nodiscard]] Machine with_settings(Machine machine, const PlanSettings& settings);

}  // namespace clsurf
