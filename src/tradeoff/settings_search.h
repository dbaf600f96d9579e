#pragma once
// The search for settings of a machine that trade time for an even surface.
//
// Xu (IEEE Trans. Autom. Sci. Eng. 2024) machined the plan closest to the time optimum and found striations that a plan 0.3
// % slower did not leave. Which limits a plan should not use fully depends on the part. Therefore many settings are
// simulated: first each setting alone, in steps, until the run takes too long; then, between neighbours on the front, the
// strictest values of both and the values halfway.

#include <functional>
#include <vector>

#include "core/progress.h"
#include "pipeline/part.h"
#include "simulation/run/simulator.h"
#include "tradeoff/front.h"
#include "tradeoff/plan_settings.h"

namespace clsurf {

struct SettingsRules {
    double more_time = 0.5;  ///< relative; settings that take longer by more than this are left out
    int runs = 48;           ///< greatest number of simulations, including that of the machine file
    Vec3 start = Vec3::Zero();
};

/// Makes the machine for settings. If they are to be written to a file, it is the machine that reading the file gives.
using MachineOfSettings = std::function<Machine(const PlanSettings&)>;

struct SettingsTradeoff {
    TradeoffFront front;                 ///< rows in ascending order of time, but the machine file first; marked
    std::vector<PlanSettings> settings;  ///< one per row
};

/// Simulates the program and judges its runs as `check` does. `program`: its motions as programmed
/// (io::ProgramOptions::coordinates empty). `judging`: how program and log are combined; identity, limits and machine in it
/// are ignored. The result does not depend on the number of threads, because runs are chosen from those of earlier rounds.
/// Throws InputError if the program cannot be run or has no adjacent passes. O(points · runs), parallel; memory: two runs
/// per thread.
[[nodiscard]] SettingsTradeoff search_settings(const Program& program, const Machine& machine,
                                               const MachineOfSettings& machine_of, const PartRules& judging,
                                               const SettingsRules& rules, const Progress& progress);

}  // namespace clsurf
