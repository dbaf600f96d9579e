#pragma once
// The optimiser: it makes proposals, simulates them, and accepts or refuses each. A proposal moves only points of finishing
// passes, so that adjacent passes are programmed alike. It is accepted only if a run on the machine is better in every respect,
// and if it is also better on other machines that are consistent with what is known of this one (ensemble.h).

#include <optional>
#include <string>
#include <vector>

#include "repair/ensemble.h"
#include "repair/proposal.h"
#include "tradeoff/front.h"

namespace clsurf {

/// Summary of a recorded run of the program.
struct Measured {
    PointIndex points = 0;
    double duration = 0;  ///< [s]
    double mismatch = 0;  ///< [mm/s] 95th percentile, as in JudgedRun
    std::size_t defects = 0;
    std::size_t motions_in_need = 0;  ///< only these are repaired
};

/// A new program that the ensemble accepts.
struct Finalist {
    std::string text;
    RunMeasures promised;  ///< on the nominal machine
    Evaluation evaluation;
    EnsembleResult ensemble;
};

/// A run on the user's controller (controller_repair.h).
struct ControllerRun {
    int candidate = 0;                      ///< 0: the program itself, or an earlier round
    std::string round{};                    ///< file of an earlier round; empty: none
    std::optional<RunMeasures> promised{};  ///< by the simulation; nothing: the program itself
    std::optional<RunMeasures> measured{};  ///< nothing: the run failed
    bool accepted = false;
    std::string reason{};  ///< why it is not accepted, or how the run failed
};

struct Optimized {
    Evaluation evaluation;   ///< by simulation, also where a recorded run was given
    bool five_axes = false;  ///< the program was run on them
    std::optional<Measured> measured;
    std::string text;  ///< text of the new program, or of the best proposal if none was accepted
    JudgedRun before, after;
    /// Roughness of both runs at the same places; nullopt: the tool is not known, or the program was run on five axes.
    std::optional<PartRoughness> roughness_before, roughness_after;
    std::string machine;               ///< origin of its values: a file, or the log to which they were fitted
    std::optional<Fidelity> fidelity;  ///< of simulations with the machine file
    EnsembleResult ensemble;           ///< of the new program; no runs: no proposal reached the ensemble
    /// Accepted by the ensemble, the best first: the first one is `text`. With OptimizeRules::all_finalists the others follow.
    std::vector<Finalist> finalists;
    /// With OptimizeRules::needs_front(): the program, and the candidates that pass all tests of one simulation. `chosen` is the
    /// one with this text.
    TradeoffFront front;
    std::vector<ControllerRun> controller_runs;
    bool on_controller = false;  ///< `before` and `after` are runs on the controller; false: both are simulated
};

/// Simulates the program, makes proposals, simulates and judges them. With a recorded run `measured` of the program, only
/// sections that need repair in that run change; proposals are still compared by simulation. A program with rotary axes is run
/// on five axes if the machine has them, and its passes are those of the tip. Throws InputError if the program cannot be run or
/// has no adjacent passes.
[[nodiscard]] Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine,
                                 const OptimizeRules& rules, std::optional<Log> measured, const Progress& progress,
                                 Diagnostics& diagnostics);

}  // namespace clsurf
