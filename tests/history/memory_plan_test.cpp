// Which runs of a fleet work at the same time: never more than the number of jobs, never beyond the memory.

#include "history/memory_plan.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"

namespace clsurf::memory_plan_test {
namespace {

TEST(MemoryPlan, StartsAsManyAsThereAreJobs) {
    MemoryPlan plan(2, 0);
    for (std::size_t k = 0; k < 3; ++k) plan.add(k, 1'000'000'000'000);
    const auto first = plan.start();
    ASSERT_TRUE(first && plan.start());
    EXPECT_FALSE(plan.start());
    EXPECT_FALSE(plan.finish(*first, true)) << "without a budget there is no second attempt";
    EXPECT_EQ(plan.start()->number, 2U);
}

TEST(MemoryPlan, ALargeRunWaitsAndSmallOnesDoNot) {
    MemoryPlan plan(8, 10);
    plan.add(0, 6);
    plan.add(1, 6);
    plan.add(2, 4);
    const auto first = plan.start();
    EXPECT_EQ(first->number, 0U);
    EXPECT_EQ(plan.start()->number, 2U);
    EXPECT_FALSE(plan.start());
    plan.finish(*first, false);
    EXPECT_EQ(plan.start()->number, 1U);
}

TEST(MemoryPlan, WhatNeededMoreIsTriedAgainAloneAndOnce) {
    MemoryPlan plan(4, 10);
    plan.add(0, 2);
    plan.add(1, 2);
    plan.add(2, 50);  // needs all of it anyway
    const auto first = plan.start();
    const auto second = plan.start();
    EXPECT_FALSE(plan.start());
    EXPECT_TRUE(plan.finish(*first, true));
    EXPECT_FALSE(plan.start()) << "the other one still works";
    plan.finish(*second, false);
    const auto large = plan.start();
    EXPECT_EQ(large->number, 2U);
    EXPECT_TRUE(large->alone);
    EXPECT_FALSE(plan.start());
    EXPECT_FALSE(plan.finish(*large, true)) << "it had everything";
    const auto again = plan.start();
    EXPECT_EQ(again->number, 0U);
    EXPECT_EQ(again->reserve, 10U);
    EXPECT_FALSE(plan.finish(*again, false));
    EXPECT_TRUE(plan.done());
}

TEST(MemoryPlan, NeverPassesItsBudgetAndEndsEveryRun) {
    std::minstd_rand random(7);
    for (int round = 0; round < 200; ++round) {
        const std::uint64_t budget = 20;
        MemoryPlan plan(1 + random() % 5, budget);
        const std::size_t runs = random() % 30;
        for (std::size_t k = 0; k < runs; ++k) plan.add(k, random() % 25);
        std::vector<PlannedRun> working;
        std::vector<int> ended(runs, 0);
        while (!plan.done()) {
            while (const auto run = plan.start()) working.push_back(*run);
            ASSERT_FALSE(working.empty());
            std::uint64_t used = 0;
            for (const PlannedRun& run : working) used += run.reserve;
            ASSERT_LE(used, budget);
            const std::size_t k = random() % working.size();
            const PlannedRun run = working[k];
            working.erase(working.begin() + static_cast<std::ptrdiff_t>(k));
            if (!plan.finish(run, random() % 4 == 0)) ++ended[run.number];
        }
        EXPECT_EQ(ended, std::vector<int>(runs, 1));
    }
}

TEST(Memory, IsReadWithItsUnit) {
    EXPECT_EQ(parse_memory("8G", "--memory"), 8ULL << 30);
    EXPECT_EQ(parse_memory("500MB", "--memory"), 500'000'000U);
    EXPECT_EQ(parse_memory("1.5GiB", "--memory"), 3ULL << 29);
    for (const char* bad : {"", "8", "G", "-1G", "0M", "8T", "1e30G", "8 G"})
        EXPECT_THROW(static_cast<void>(parse_memory(bad, "--memory")), UsageError) << bad;
}

}  // namespace
}  // namespace clsurf::memory_plan_test
