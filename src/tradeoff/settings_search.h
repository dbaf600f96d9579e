#pragma once
// The search for settings of a machine that trade time for an even surface.
//
// Xu (IEEE Trans. Autom. Sci. Eng. 2024) cut the plan closest to the time optimum and found striations that one 0.3 % slower did not
// leave. Which limits a plan should leave unused depends on the part, so that many are simulated: first each setting by itself,
// in steps, until the run takes too long; then, between neighbours on the front, the strictest of both and what lies
// half-way.

#include <functional>
#include <vector>

#include "core/progress.h"
#include "pipeline/part.h"
#include "simulation/run/simulator.h"
#include "tradeoff/front.h"
#include "tradeoff/plan_settings.h"

namespace clsurf {

struct SettingsRules {
    double more_time = 0.5;  ///< a share: settings that take longer than this more are left out
    int runs = 48;           ///< simulations at most, that of the machine file included
    Vec3 start = Vec3::Zero();
};

/// The machine of settings. Where they are to be written to a file, the machine that reading the file gives.
using MachineOfSettings = std::function<Machine(const PlanSettings&)>;

struct SettingsTradeoff {
    TradeoffFront front;  ///< rows in rising order of time, but the machine file first; the front is marked
    std::vector<PlanSettings> settings;  ///< one a row
};

/// Simulates the program and judges its runs as `check` does. `program`: its motions as programmed
/// (io::ProgramOptions::coordinates empty). `judging`: how program and log are put together; identity, limits and machine are not asked. The result
/// does not depend on the number of threads: runs are chosen from those of earlier rounds. Throws InputError if the
/// program cannot be run or has no adjacent passes. O(points · runs), parallel; memory: that of two runs a thread.
[[nodiscard]] SettingsTradeoff search_settings(const Program& program, const Machine& machine,
                                               const MachineOfSettings& machine_of, const PartRules& judging,
                                               const SettingsRules& rules, const Progress& progress);

}  // namespace clsurf
