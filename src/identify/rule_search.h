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

/// A value of a rule, and how it is set in a machine.
struct RuleValue {
    std::string name;
    std::function<void(Machine&)> apply;
};

/// The values of a rule as increasing numbers, if numbers between them are possible.
struct ContinuousValues {
    std::vector<double> numbers{};  ///< empty: there are none
    std::function<void(Machine&, double)> set{};
    double unit = 1;  ///< of the machine file, in internal units
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
    /// `runs` must outlive the object. The longest runs are left out above 2·10^5 records in total, with rotary axes above
    /// 5·10^4.
    explicit RuleScores(std::span<const RecordedRun> runs);

    /// |difference of speed| of every sample, the mean of 32 records [mm/s]; NaN: not compared. Machines with the same plan,
    /// and those that merge the same lines, are simulated only once.
    [[nodiscard]] std::vector<float> residuals(const Machine& machine);
    /// Mean |difference of speed| over the compared samples [mm/s].
    [[nodiscard]] double mean_error(const Machine& machine);
    /// Simulates the machines that are not known yet, in parallel, for use by residuals().
    void prepare(std::span<const Machine> machines);
    /// The error of a sample that the simulation does not pass [mm/s].
    [[nodiscard]] double usual_speed() const { return static_cast<double>(usual_speed_); }
    /// Smaller mean differences do not distinguish planners [mm/s].
    [[nodiscard]] double resolution() const;
    /// Whether any simulation so far shares a part of the path with a run: if not, rules cannot be compared.
    [[nodiscard]] bool has_compared() const;
    /// Whether a run has arcs.
    [[nodiscard]] bool has_arcs() const;
    /// Whether the right planner with the right values may leave this mean difference [mm/s].
    [[nodiscard]] bool explains(double mean_error) const;

private:
    struct Scored {
        Machine machine;
        std::vector<float> residuals;
    };
    /// A tolerance of a planner, and the lines of all runs that remain after merging within it.
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
    /// `machines`: results of merging_alike().
    void simulate_unknown(std::span<const Machine> machines);
    /// The index of a machine with the same plan; the number of machines if there is none.
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

/// A difference of scores that distinguishes two machines: "very strong" evidence (Kass and Raftery 1995).
inline constexpr double decisive = 10;

/// How well machines explain the runs, from their residuals, over the samples that any of them has.
[[nodiscard]] std::vector<Explanation> compare(const std::vector<std::vector<float>>& residuals,
                                               const RuleScores& scores);

/// Searches one rule and keeps the value that explains the runs best. A value other than the present one must lower the
/// mean error of the speed by more than the share `least_gain`, and by more than a tenth if the runs do not distinguish
/// them. `present`: the index of the machine's value, size() if it has none of them. Between the values of a continuous
/// rule the best number is searched by Brent's method, to three digits, if the runs distinguish the values.
void search_rule(const Rule& rule, std::size_t present, double least_gain, RuleScores& scores, Identification& result);

}  // namespace clsurf
