#pragma once
// The optimiser: propose, simulate, accept or refuse. A proposal moves points of finishing passes (and only
// those) so that neighbour passes are programmed alike; it is taken only where a run on the machine
// shows it to be better in every respect.

#include <optional>
#include <string>

#include "optimize/proposal.h"

namespace clsurf {

/// What a recorded run of the program shows.
struct Measured {
    PointIndex points = 0;
    double duration = 0;  ///< [s]
    double mismatch = 0;  ///< [mm/s] 95th percentile, as JudgedRun has it
    std::size_t defects = 0;
    std::size_t motions_in_need = 0;  ///< which alone are repaired
};

struct Optimized {
    Proof proof;             ///< by simulation, also where a recorded run was given
    bool five_axes = false;  ///< the program was run on them
    std::optional<Measured> measured;
    std::string text;  ///< of the new program; that of the best proposal where none was accepted
    JudgedRun before, after;
    SimulationSummary run_before, run_after;
};

/// Runs the program, proposes, runs and judges the proposals. With a recorded run `measured` of the program, only what that
/// run shows to be in need is changed; what a proposal is worth is found by simulation, before and after. A program that names
/// rotary axes is run on five where the machine has them: its passes are those of the tip. Throws
/// InputError where the program cannot be run or has no passes beside each other.
[[nodiscard]] Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine,
                                 const OptimizeRules& rules, std::optional<Log> measured, const Progress& progress,
                                 Diagnostics& diagnostics);

}  // namespace clsurf
