#pragma once
// An ensemble of machines, all consistent with what is known of one machine. A new program must be better on them.

#include <memory>
#include <string>
#include <vector>

#include "machine/machine.h"
#include "repair/judged_run.h"
#include "repair/optimize_rules.h"

namespace clsurf {

/// One machine's runs of the program and of the new program.
struct EnsembleRun {
    RunMeasures before, after;
    double gain = 0;  ///< of the objective, as a share
};

struct EnsembleResult {
    std::vector<EnsembleRun> runs;  ///< one for each machine; empty: there are no machines

    /// The run with the smallest gain. There must be runs.
    [[nodiscard]] const EnsembleRun& worst() const;
    /// Means of all measures and gains. There must be runs.
    [[nodiscard]] EnsembleRun mean() const;
};

/// Longest additional time on one machine of the ensemble, as a share. The mean must not be longer at all
/// (docs/optimize.md#the-ensemble).
inline constexpr double most_time_on_one_machine = 0.005;

/// Why the new program is not better. On the mean it must be better in mismatch, defects and time, and by least_gain; on every
/// machine in defects, in the objective and, up to most_time_on_one_machine, in time. Empty: it is, or there are no machines.
[[nodiscard]] std::string why_not_better(const EnsembleResult& result, double more_time);

class Ensemble {
public:
    /// The program is run on every machine when the first new program comes. All must outlive the ensemble.
    Ensemble(const Program& program, std::vector<Machine> machines, const OptimizeRules& rules,
             std::shared_ptr<const Kinematics> kinematics);

    /// Runs a new program on every machine. Throws what simulate() throws. O(points) for each machine, parallel.
    [[nodiscard]] EnsembleResult run(const Program& changed);

private:
    [[nodiscard]] JudgedRun judged(const Program& program, const Machine& machine) const;
    const Program& program_;
    std::vector<Machine> machines_;
    const OptimizeRules& rules_;
    std::shared_ptr<const Kinematics> kinematics_;
    std::vector<RunMeasures> before_;  ///< of the program, one per machine
};

}  // namespace clsurf
