#pragma once
// Proposals: changed programs, run and held against the program as it is.

#include <functional>
#include <memory>
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

/// Reads a text in the program's dialect, as the program itself was read.
using ReadProgram = std::function<Program(const std::string& text)>;

/// A program whose points were moved, before feeds are set.
struct Draft {
    Program program;
    std::string text;
    std::size_t stretches = 0, changed_lines = 0;
    std::vector<std::uint8_t> may_slow;  ///< per motion, whether it may get a feed; empty: all may
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

/// Runs proposals on the machine.
class Prover {
public:
    /// Runs the program itself. All must outlive it. Throws what simulate() throws.
    Prover(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, const Progress& progress, Diagnostics& diagnostics);

    [[nodiscard]] const JudgedRun& before() const { return before_; }
    [[nodiscard]] JudgedRun take_before() { return std::move(before_); }
    [[nodiscard]] const SimulationSummary& summary_before() const { return summary_before_; }
    /// Of proposals simulated so far.
    [[nodiscard]] double points() const { return points_; }

    /// `targets`: as those of a Proposal, or none at all.
    [[nodiscard]] Proposal prove(const std::shared_ptr<const Draft>& draft, std::vector<float> targets);

    /// Accepted ones are better than others; then what leaves less mismatch and defects, and of two that are nearly as good the shorter.
    [[nodiscard]] bool better(const Proposal& a, const Proposal& b) const;

    /// The less, the better: what is left of mismatch and defects, as shares, and the growth.
    [[nodiscard]] double score(const Proposal& proposal) const;

private:
    [[nodiscard]] std::string objection(const Proposal& proposal) const;
    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    const Progress& progress_;
    Diagnostics& diagnostics_;
    JudgedRun before_;
    SimulationSummary summary_before_;
    double points_ = 0;
};

}  // namespace clsurf
