#include "identify/parameter_uncertainty.h"

#include <gtest/gtest.h>

namespace clsurf::parameter_uncertainty_test {
namespace {

TEST(ParameterUncertainty, AStandardErrorCountsRelativeToTheValue) {
    Identification result;
    result.parameters.push_back({.name = "max_acceleration",
                                 .axis = "x",
                                 .value = 2000,
                                 .unit = "mm/s²",
                                 .standard_error = 50,
                                 .reached = true,
                                 .note = ""});
    const auto rows = uncertainty_of(result);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].key, "max_acceleration");
    EXPECT_EQ(rows[0].of, "x");
    EXPECT_DOUBLE_EQ(rows[0].relative_error, 0.025);
}

TEST(ParameterUncertainty, ALimitThatWasNotReachedIsALowerBound) {
    Identification result;
    result.parameters.push_back({.name = "max_acceleration",
                                 .axis = "z",
                                 .value = 900,
                                 .unit = "mm/s²",
                                 .standard_error = {},
                                 .reached = false,
                                 .note = ""});
    const auto rows = uncertainty_of(result);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_DOUBLE_EQ(rows[0].lower_bound, 900);
    EXPECT_DOUBLE_EQ(rows[0].relative_error, 0);
}

TEST(ParameterUncertainty, ServoLoopsDoNotPlan) {
    Identification result;
    result.parameters.push_back({.name = "position_gain",
                                 .axis = "x",
                                 .value = 100,
                                 .unit = "1/s",
                                 .standard_error = 1,
                                 .reached = {},
                                 .note = ""});
    EXPECT_TRUE(uncertainty_of(result).empty());
}

TEST(ParameterUncertainty, ValuesThatExplainTheRunsAlikeAreAlternatives) {
    Identification result;
    const auto candidate = [](const char* value, bool equal) {
        RuleCandidate c;
        c.rule = "lookahead_blocks";
        c.axis = "controller";
        c.value = value;
        c.equal = equal;
        return c;
    };
    result.rules = {candidate("20", false), candidate("50", true), candidate("200", true)};
    const auto rows = uncertainty_of(result);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].key, "lookahead_blocks");
    EXPECT_EQ(rows[0].alternatives, (std::vector<double>{50, 200}));
    // A single candidate has no uncertainty, and words have none because they are not numbers.
    result.rules = {candidate("50", true), candidate("arc", true), candidate("spline", true)};
    EXPECT_TRUE(uncertainty_of(result).empty());
}

}  // namespace
}  // namespace clsurf::parameter_uncertainty_test
