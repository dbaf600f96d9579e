#pragma once
// Rules of a planner as candidates that are simulated and scored against recorded runs.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "identify/identification.h"
#include "identify/run_fidelity.h"

namespace clsurf {

/// A value of a rule, and how a machine gets it.
struct RuleValue {
    std::string name;
    std::function<void(Machine&)> apply;
};

/// The numbers of a rule's values, in their order and rising, where other numbers between them are possible.
struct ContinuousValues {
    std::vector<double> numbers{};  ///< empty: there are no others
    std::function<void(Machine&, double)> set{};
    double unit = 1;  ///< of the machine file, in ours
};

struct Rule {
    std::string name, axis;
    std::vector<RuleValue> values;
    ContinuousValues continuous;
};

/// Whether two machines have the same values of all rules and limits.
[[nodiscard]] bool plan_alike(const Machine& one, const Machine& other);

/// Scores machines against the runs.
class RuleScores {
public:
    /// `runs` must outlive it; long ones beyond 2·10^5 records in all are left out, beyond 5·10^4 with rotary axes.
    explicit RuleScores(std::span<const RecordedRun> runs);

    /// |difference of speed| at every sample [mm/s]; NaN: not compared. Machines that plan alike, and those that merge the same
    /// lines, are simulated once.
    [[nodiscard]] std::vector<float> residuals(const Machine& machine);
    /// Mean |difference of speed| over the samples that the machine has [mm/s].
    [[nodiscard]] double mean_error(const Machine& machine);
    /// Simulates those of the machines that are not known yet, in parallel, so that residuals() finds them.
    void prepare(std::span<const Machine> machines);
    /// The speed that a place counts as wrong by where the simulation does not go there [mm/s].
    [[nodiscard]] double usual_speed() const { return static_cast<double>(usual_speed_); }
    /// No smaller mean difference [mm/s] tells planners apart.
    [[nodiscard]] double resolution() const;
    /// Whether any simulation so far goes where a run goes: otherwise no rule explains less than another.
    [[nodiscard]] bool has_compared() const;
    /// Whether a run has arcs.
    [[nodiscard]] bool has_arcs() const;
    /// Whether a mean difference [mm/s] is what the right planner with the right values may leave.
    [[nodiscard]] bool explains(double mean_error) const;

private:
    struct Scored {
        Machine machine;
        std::vector<float> residuals;
    };
    /// A tolerance of a planner, and the lines of all runs that merging within it leaves.
    struct Merging {
        PlannerKind planner;
        std::optional<double> tolerance;
        std::vector<LineNumber> lines;
    };
    struct Residuals {
        std::vector<float> of_speed;
        float usual_speed = 0;
    };
    [[nodiscard]] static Residuals simulated(const RecordedRun& run, const Machine& machine);
    /// Of machines that merging_alike() has returned.
    void simulate_unknown(std::span<const Machine> machines);
    /// Of one that plans alike; the number of all: there is none.
    [[nodiscard]] std::size_t index_of_scored(const Machine& machine) const;
    [[nodiscard]] Machine merging_alike(const Machine& machine);

    std::vector<Scored> scored_;
    std::vector<Merging> mergings_;
    std::vector<const RecordedRun*> runs_;
    float usual_speed_ = 0;
};

/// How well a machine explains the runs.
struct Explanation {
    double score = 0;        ///< see RuleCandidate
    double speed_error = 0;  ///< [mm/s] mean |difference| of the speed
};

/// A difference of scores that tells two machines apart: "very strong" evidence (Kass and Raftery 1995).
inline constexpr double decisive = 10;

/// How well machines explain the runs, by their residuals, over the samples that any of these has.
[[nodiscard]] std::vector<Explanation> compare(const std::vector<std::vector<float>>& residuals,
                                               const RuleScores& scores);

/// Searches one rule and keeps the value that explains the runs best. Another value than the present one must lower the mean
/// error of the speed by more than the share `least_gain`, and by more than a tenth where the runs do not distinguish them.
/// `present`: the index of the value that the machine has, size() where it has none of them. Between the values of a continuous
/// rule the best number is sought by Brent's method, to three digits, where the runs tell the values apart.
void search_rule(const Rule& rule, std::size_t present, double least_gain, RuleScores& scores, Identification& result);

}  // namespace clsurf
