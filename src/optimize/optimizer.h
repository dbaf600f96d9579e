#pragma once
// The optimiser: propose, simulate, accept or refuse. A proposal moves points of finishing passes (and only
// those) so that neighbour passes are programmed alike; it is taken only where a run on the machine
// shows it to be better in every respect.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "optimize/deviation.h"
#include "optimize/run.h"

namespace clsurf {

struct OptimizeRules {
    double tolerance = 0.005;   ///< [mm] from the programmed path
    int least_decimals = 0;     ///< of new coordinates; 0: as many as the program has
    Vec3 start = Vec3::Zero();  ///< [mm] where the axes stand before the program
    QualityRules quality;
    std::string header;         ///< text of the comment that says where the program comes from
};

/// A proposal held against the program.
struct Proof {
    bool accepted = false;
    std::string reason;         ///< why not, or empty
    Deviation deviation;
    std::size_t intervals = 0;  ///< stretches that were changed
    LineNumber lines_before = 0, lines_after = 0;
    std::size_t changed_lines = 0;  ///< of the old program
    std::size_t defects_before = 0, defects_after = 0;  ///< by the thresholds of the run before
};

/// What a recorded run of the program shows.
struct Measured {
    PointIndex points = 0;
    double duration = 0;   ///< [s]
    double mismatch = 0;   ///< [mm/s] 95th percentile, as JudgedRun has it
    std::size_t defects = 0;
    std::size_t motions_in_need = 0;  ///< which alone are repaired
};

struct Optimized {
    Proof proof;               ///< by simulation, also where a recorded run was given
    std::optional<Measured> measured;
    std::string text;          ///< of the new program; that of the best proposal where none was accepted
    JudgedRun before, after;
    SimulationSummary run_before, run_after;
};

/// Reads a text in the program's dialect, as the program itself was read.
using ReadProgram = std::function<Program(const std::string& text)>;

/// Runs the program, proposes, runs and judges the proposals. With a recorded run `measured` of the program, only what that
/// run shows to be in need is changed; what a proposal is worth is found by simulation, before and after. Throws
/// InputError where the program cannot be run or has no passes beside each other.
[[nodiscard]] Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, std::optional<Log> measured, const Progress& progress, Diagnostics& diagnostics);

}  // namespace clsurf
