#pragma once
// Proposals: changed programs, run and held against the program as it is.

#include <memory>
#include <string>
#include <vector>

#include "core/units.h"
#include "optimize/deviation.h"
#include "optimize/draft.h"
#include "optimize/run.h"

namespace clsurf {

/// How far the tool axis may be turned away from the programmed one: a hundredth of a degree takes the centre of a ball of
/// 6 mm radius 1 µm aside.
inline constexpr double most_turned = 0.01 * rad_per_deg;

/// Each place of a systematic lag counts: each may be levelled.
[[nodiscard]] inline QualityRules judged_place_by_place() {
    QualityRules rules;
    rules.group_systematic = false;
    return rules;
}

struct OptimizeRules {
    double tolerance = 0.005;   ///< [mm] from the programmed path
    double more_time = 0;       ///< a share: how much longer the new program may take
    int least_decimals = 0;     ///< of new coordinates; 0: as many as the program has
    Vec3 start = Vec3::Zero();  ///< [mm] where the axes stand before the program
    Vec3 zero = Vec3::Zero();   ///< [mm] machine position of its zero, on five axes
    QualityRules quality = judged_place_by_place();
    std::string header;  ///< text of the comment that says where the program comes from
};

/// A proposal held against the program.
struct Proof {
    bool accepted = false;
    std::string reason;  ///< why not, or empty
    Deviation deviation;
    std::size_t intervals = 0;  ///< stretches that were changed
    LineNumber lines_before = 0, lines_after = 0;
    std::size_t changed_lines = 0;                      ///< of the old program
    std::size_t defects_before = 0, defects_after = 0;  ///< by the thresholds of the run before
};

/// A draft with feeds, its run, and how that holds against the program's.
struct Proposal {
    std::shared_ptr<const Draft> draft;
    std::vector<float> targets;  ///< [mm/s] per motion of the draft: speeds that feeds hold it to; 0: none
    Proof proof;
    std::string text;
    JudgedRun run;
    SimulationSummary summary;
};

using Tried = std::shared_ptr<Proposal>;

/// Runs proposals on the machine and keeps the best of them.
class Prover {
public:
    /// Runs the program itself. All must outlive it. Throws what simulate() throws.
    Prover(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules,
           const Progress& progress, Diagnostics& diagnostics);

    [[nodiscard]] const JudgedRun& before() const { return before_; }
    [[nodiscard]] JudgedRun take_before() { return std::move(before_); }
    [[nodiscard]] const SimulationSummary& summary_before() const { return summary_before_; }
    /// How long a proposal may take [s]: not longer than the program did, until more is allowed.
    [[nodiscard]] double longest() const { return before_.duration * (1 + more_time_); }
    /// From now on what the rules allow. As much of the search is left, at least, as with half of it done.
    void allow_more_time();
    /// nullptr: the program is not run on five axes.
    [[nodiscard]] const Orientation* orientation() const { return orientation_.get(); }
    [[nodiscard]] const std::shared_ptr<const Kinematics>& kinematics() const { return kinematics_; }
    /// Whether there is time for one more (for the first one there always is): all runs together have a bound, of which a share may be
    /// used, and so have those in a row that are no better than the best.
    [[nodiscard]] bool has_time(double share = 1) const;

    /// `targets`: as those of a Proposal, or none at all.
    Tried propose(const std::shared_ptr<const Draft>& draft, std::vector<float> targets);
    [[nodiscard]] const Tried& best() const { return best_; }

    /// Accepted ones are better than others; then what leaves less mismatch and defects, and of two that are nearly as good the shorter.
    [[nodiscard]] bool better(const Proposal& a, const Proposal& b) const;

    /// The less, the better: what is left of mismatch and defects, as shares, the growth, and the time beyond that before where
    /// more is allowed.
    [[nodiscard]] double score(const Proposal& proposal) const;

private:
    [[nodiscard]] Proposal prove(const std::shared_ptr<const Draft>& draft, std::vector<float> targets);
    [[nodiscard]] Deviation deviation_of(const Program& changed) const;
    [[nodiscard]] double most_points() const;
    [[nodiscard]] std::string objection(const Proposal& proposal) const;
    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    const Progress& progress_;
    Diagnostics& diagnostics_;
    std::shared_ptr<const Kinematics> kinematics_;  ///< of a program that is run on five axes
    std::unique_ptr<const Orientation> orientation_;
    JudgedRun before_;
    SimulationSummary summary_before_;
    Tried best_;
    double more_time_ = 0;  ///< a share
    double points_ = 0;     ///< simulated so far
    int in_vain_ = 0;       ///< proposals since the best one
};

}  // namespace clsurf
