#pragma once
// Repair by runs on the user's own controller, which decides instead of the simulation: by a command that runs programs and
// writes their logs, or by logs of earlier rounds.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "repair/optimizer.h"

namespace clsurf {

/// The result of a run on the controller: a log, or the reason of its failure, as a clause.
struct ControllerOutcome {
    std::optional<Log> log;
    std::string failure;
};

/// Runs the text of a program on the controller. The log has the channels that judge_run() needs.
using RunOnController = std::function<ControllerOutcome(const std::string& text)>;

/// A program and the log of its run.
struct ControllerLog {
    std::string text;
    Log log;
};
/// Fits a machine to the logs so far; parameters that they do not determine keep the values of `known`.
using FitMachine = std::function<Machine(const std::vector<ControllerLog>& logs, const Machine& known)>;

struct ControllerJudge {
    RunOnController run;  ///< nullptr: there is no controller; the simulation decides on the next candidate
    FitMachine fit;
    int runs = 3;  ///< largest number of runs, including the program's own if it has no log
};

/// A repaired program of an earlier round, and its run.
struct EarlierRound {
    std::string name;  ///< of its file
    ControllerLog run;
};

/// Runs the program (unless `measured` is its log), fits the machine to the log, repairs on the simulated machine, and runs the
/// best candidates. A candidate is accepted by its log: better than the log of the program in every respect, and by least_gain.
/// If a log differs from the simulation, the machine is fitted again to all logs and the search repeated.
///
/// The machine is also fitted to the logs of `rounds`. A candidate must be better than each of them, with a gain that exceeds
/// theirs by least_gain: by its log, or by its simulation if there is no controller. `before` and `after` of the result are
/// runs on the controller; without any run of a candidate, both are simulated. A failed run counts as one of `runs`.
///
/// Throws InputError if the program itself cannot be run, or a log of `rounds` does not belong to its program, and what
/// optimize() throws. Without a controller, `measured` is required.
[[nodiscard]] Optimized optimize_on_controller(const Program& program, const ReadProgram& read, const Machine& machine,
                                               OptimizeRules rules, const ControllerJudge& judge,
                                               std::optional<Log> measured, const std::vector<EarlierRound>& rounds,
                                               const Progress& progress, Diagnostics& diagnostics);

}  // namespace clsurf
