// Runs on other machines: what they count.

#include "repair/ensemble.h"

#include <gtest/gtest.h>

#include "repair/parts.h"

namespace clsurf::ensemble_test {
namespace {

/// Different loops: the axes have different lags, so that the lag of forward and backward passes differs nearly everywhere.
Machine uneven_loops() {
    Machine machine;
    machine.path.max_jerk = 1e6;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 2e6;
    machine.axes[2].servo.position_gain = 40;
    machine.axes[2].servo.velocity_feedforward = 0.8;
    return machine;
}

// A systematic lag is one property of a machine. Its places vary from machine to machine, and would hide the effects of a new
// program.
TEST(Ensemble, ASystematicLagCountsOnceAsInCheck) {
    const Program program = read_text(wavy_zigzag(12, 20, [](int, double) { return 0.3; }));
    const Machine machine = uneven_loops();
    const OptimizeRules rules;
    Diagnostics diagnostics;
    const std::vector<Defect> defects =
        judge_run(simulate_to_log(program, machine).log, program, diagnostics).report.defects;
    ASSERT_TRUE(std::ranges::any_of(defects, &Defect::systematic)) << "the part has no systematic lag";
    Ensemble ensemble(program, {machine}, rules, nullptr);
    const EnsembleResult result = ensemble.run(program);
    ASSERT_EQ(result.runs.size(), 1U);
    EXPECT_DOUBLE_EQ(result.runs[0].before.defects, static_cast<double>(defects.size()));
    EXPECT_DOUBLE_EQ(result.runs[0].after.defects, static_cast<double>(defects.size()));
}

// A promise that one machine would break may be broken by the real one: the mean is not sufficient then.
TEST(Ensemble, NoMachineMayHaveMoreDefects) {
    const RunMeasures before{.mismatch = 10, .defects = 20, .duration = 100, .speed = 50};
    const auto with = [&](double defects) {
        return EnsembleRun{before, {.mismatch = 4, .defects = defects, .duration = 100, .speed = 50}, 0.2};
    };
    EXPECT_EQ(why_not_better(EnsembleResult{{with(10), with(20)}}, 0), "");
    EXPECT_EQ(
        why_not_better(EnsembleResult{{with(10), with(21)}}, 0),
        "on one of 2 machines within the uncertainty of the machine file, there would be 21 defects instead of 20");
}

}  // namespace
}  // namespace clsurf::ensemble_test
