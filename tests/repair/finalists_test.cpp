// The proposals among which an ensemble of machines chooses.

#include <gtest/gtest.h>

#include <memory>

#include "repair/draft.h"
#include "repair/parts.h"
#include "repair/proposal.h"
#include "repair/repair_mask.h"

namespace clsurf::finalists_test {
namespace {

double crowded(int pass, double x) { return pass == 2 && x > 3 && x < 5 ? 0.02 : 0.31; }

// An ensemble may refuse the best ones because of one machine: others must remain. Proposals with equal runs would be refused
// together.
TEST(Finalists, AreManyThatDifferTheBestFirst) {
    const Program program = read_text(wavy_zigzag(6, 9, crowded));
    const Machine machine = slow_at_short_blocks();
    const ReadProgram read = read_text;
    const OptimizeRules rules;
    const Progress silent;
    Diagnostics diagnostics;
    Evaluator evaluator(program, read, machine, rules, silent, diagnostics);
    const Drafter drafter(program, read, machine, rules, true);
    const auto draft =
        std::make_shared<const Draft>(drafter.draft({0.001, 0.11}, repair_mask(evaluator.before(), program, {})));
    for (const double feed : {47.0, 49.8, 48.5, 49.0, 47.5, 49.5, 48.0, 49.0, 49.8}) {  // two of them twice
        const std::vector<float> targets(static_cast<std::size_t>(draft->program.motions.size()),
                                         static_cast<float>(feed));
        ASSERT_EQ(evaluator.propose(draft, targets)->evaluation.reason, "") << feed;
    }
    const std::vector<TriedProposal> finalists = evaluator.finalists();
    ASSERT_EQ(finalists.size(), 7U);
    for (std::size_t k = 1; k < finalists.size(); ++k) {
        EXPECT_LE(evaluator.score(*finalists[k - 1]), evaluator.score(*finalists[k])) << k;
        EXPECT_NE(finalists[k - 1]->run.duration, finalists[k]->run.duration) << k;
    }
}

}  // namespace
}  // namespace clsurf::finalists_test
