#pragma once
// Proposals: changed programs, simulated and compared with the original program.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machined/part_roughness.h"
#include "pipeline/roughness_gauge.h"
#include "repair/draft.h"
#include "repair/judged_run.h"
#include "repair/optimize_rules.h"
#include "repair/points/deviation.h"
#include "tradeoff/front.h"

namespace clsurf {

/// The comparison of a proposal with the program.
struct Evaluation {
    bool accepted = false;
    std::string reason;  ///< why it was not accepted, or empty
    Deviation deviation;
    std::size_t intervals = 0;  ///< number of changed sections
    std::size_t splines = 0;    ///< number of them that are written as splines
    LineNumber lines_before = 0, lines_after = 0;
    std::size_t changed_lines = 0;  ///< number of changed lines of the old program
    std::size_t defects_before = 0, defects_after = 0;
};

/// A draft with feeds, its run, and the comparison with the run of the program.
struct Proposal {
    std::shared_ptr<const Draft> draft;
    std::vector<float> targets;  ///< [mm/s] per motion of the draft: speed limits for which feeds are set; 0: none
    Evaluation evaluation;
    std::string text;
    JudgedRun run;
    SimulationSummary summary;
    std::optional<RoughnessChange> roughness{};  ///< from the program to a finalist, if the tool is known
    int number = 0;                              ///< in the order of trials, from 1

    [[nodiscard]] RunMeasures measures() const;
};

using TriedProposal = std::shared_ptr<Proposal>;

/// Runs proposals on the machine and keeps the best of them.
class Evaluator {
public:
    /// Runs the program itself. All must outlive it. Throws what simulate() throws.
    Evaluator(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules,
              const Progress& progress, Diagnostics& diagnostics);

    [[nodiscard]] const JudgedRun& before() const { return before_; }
    [[nodiscard]] JudgedRun take_before() { return std::move(before_); }
    /// The longest run that feeds may cause [s]: the time of the program, unless more is allowed; slightly less if other
    /// machines must not take longer either.
    [[nodiscard]] double longest() const;
    /// Applies the time that the rules allow from now on. At least half of the search remains after that.
    void allow_more_time();
    /// nullptr: the program is not run on five axes.
    [[nodiscard]] const Orientation* orientation() const { return orientation_.get(); }
    [[nodiscard]] const std::shared_ptr<const Kinematics>& kinematics() const { return kinematics_; }
    /// Whether one more proposal may be tried (always for the first one). The total number of simulated points is limited, and
    /// a share of it may be used now. The number of consecutive proposals without improvement is also limited.
    [[nodiscard]] bool has_time(double share = 1) const;
    /// How many runs of the program have as many simulated points as the whole search.
    [[nodiscard]] double most_runs() const;

    /// `targets`: as in a Proposal, or empty.
    TriedProposal propose(const std::shared_ptr<const Draft>& draft, std::vector<float> targets);
    [[nodiscard]] const TriedProposal& best() const { return best_; }
    /// The accepted proposals with the lowest scores, the lowest first; those that measure_roughness() refused come last. Few
    /// if runs are long. Some have no feeds, if there are such proposals.
    [[nodiscard]] std::vector<TriedProposal> finalists() const;

    /// Makes the candidates of the front that a weight prefers the finalists, the best one first, and runs them again. Domain:
    /// OptimizeRules::needs_front().
    void prefer(double weight);
    /// The program and then the accepted candidates in ascending order of time. `chosen`: one of them, or nullptr. Domain:
    /// OptimizeRules::needs_front().
    [[nodiscard]] TradeoffFront front(const Proposal* chosen) const;

    /// Measures the roughness of the surfaces of the program and of the finalists. From then on it counts in scores and for
    /// acceptance. For programs on three axes.
    void measure_roughness(const CuttingTool& tool);
    /// nullopt: it is not measured.
    [[nodiscard]] const std::optional<PartRoughness>& roughness_before() const { return roughness_before_; }

    /// Accepted proposals are better than others; then, if splines are requested, proposals with splines; then the one with
    /// less remaining mismatch and fewer defects; of two nearly equal ones the shorter.
    [[nodiscard]] bool better(const Proposal& a, const Proposal& b) const;

    /// Reports the present step as progress. Thread-safe.
    void report_progress(std::string_view what) const;

    /// Lower is better: objective() relative to the run of the program.
    [[nodiscard]] double score(const Proposal& proposal) const;

private:
    /// Points of a run. Fewer runs are made of a larger one, which bounds time and memory
    /// (docs/experiments/repair.md#the-search-in-detail, Evaluation).
    static constexpr double large_run = 1e6;
    /// The data of a proposal for its comparison and for another run.
    struct Candidate {
        int number = 0;
        std::shared_ptr<const Draft> draft;
        std::vector<float> targets;
        Evaluation evaluation;
        RunMeasures measures;
        bool limits_ok = false;
        TradeoffRow row;
    };
    /// The accepted ones, in ascending order of time.
    [[nodiscard]] std::vector<const Candidate*> accepted_candidates() const;
    [[nodiscard]] TradeoffFront front_of(const std::vector<const Candidate*>& candidates) const;
    void keep_candidate(const Proposal& proposal);
    [[nodiscard]] Proposal evaluate(const std::shared_ptr<const Draft>& draft, std::vector<float> targets);
    [[nodiscard]] Deviation deviation_of(const Program& changed) const;
    [[nodiscard]] double most_points() const;
    /// "candidate 14, best: gain 61 %, 3 defects, 38.0 s".
    [[nodiscard]] std::string candidate_text() const;
    /// Measures of the program, with its roughness as far as it is compared with that of the proposal.
    [[nodiscard]] RunMeasures measures_before(const Proposal& proposal) const;
    [[nodiscard]] std::string objection(const Proposal& proposal) const;
    [[nodiscard]] std::string objection(const Evaluation& evaluation, const RunMeasures& before,
                                        const RunMeasures& after, bool limits_ok) const;
    void keep_finalist(const TriedProposal& proposal, std::vector<TriedProposal>& finalists) const;
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
    std::optional<PartRoughness> roughness_before_;
    TriedProposal best_;
    std::vector<TriedProposal> with_feeds_, without_feeds_;  ///< finalists
    std::vector<TriedProposal> preferred_;                   ///< finalists selected by a weight, used instead of these
    std::vector<Candidate> candidates_;                      ///< all, with OptimizeRules::keeps_front
    double more_time_ = 0;                                   ///< a share
    double points_ = 0;                                      ///< simulated so far
    int since_best_ = 0;                                     ///< proposals since the best one
    int tried_ = 0;                                          ///< number of proposals
};

}  // namespace clsurf
