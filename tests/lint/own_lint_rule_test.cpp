// A lint rule of another program: one row, which clsurf does not contain.

#include <gtest/gtest.h>

#include "io/reports/lint_report.h"
#include "lint/lint.h"
#include "lint/lint_rule.h"
#include "repair/parts.h"

namespace clsurf::own_lint_rule_test {
namespace {

constexpr double slowest = 20;  // [mm/s]

std::string say_slow(const LintFinding& finding, const std::string& found, const std::string& expected) {
    return fmt::format("feed {} on pass {}, below {}", found, finding.pass, expected);
}

void check_slow(const LintContext& context, const LintRule& rule, std::vector<LintFinding>& findings) {
    find_runs(
        context, rule, {},
        [&](const ProgrammedPass&, PointIndex point) -> std::optional<LintMeasure> {
            const double feed = context.feed_at(point);
            return feed < slowest ? std::optional(LintMeasure{feed, slowest, -1}) : std::nullopt;
        },
        findings);
}

constexpr LintRule slow{
    "slow-feed", "The feed is slower than our machines run well", {"mm/min", 60, 0}, say_slow, check_slow};

Program slow_pass() {
    std::string text = wavy_zigzag(9, 12, [](int, double) { return 0.3; });
    text.insert(text.find('\n', text.find("Y1.2000")), " F600");  // the fourth pass
    text.insert(text.find('\n', text.find("Y1.6000")), " F3000");
    return read_text(text);
}

TEST(OwnLintRule, IsOneRow) {
    const Program program = slow_pass();
    const LintReport report = lint(program, build_programmed_surface(program), {}, std::span(&slow, 1));
    ASSERT_GE(report.count("slow-feed"), 1U);
    EXPECT_EQ(report.findings.size(), report.count("slow-feed"));
    EXPECT_NEAR(report.findings.front().found, 10, 1e-9);
    EXPECT_EQ(message_of(report.findings.front()).substr(0, 16), "feed 600 mm/min ");
}

TEST(OwnLintRule, StandsBesideOursInEveryReport) {
    const Program program = slow_pass();
    std::vector<LintRule> rules(lint_rules().begin(), lint_rules().end());
    rules.push_back(slow);
    const LintReport report = lint(program, build_programmed_surface(program), {}, rules);
    EXPECT_GE(report.count("feed-difference"), 1U);
    const std::vector<io::ReportedLint> reported{{program.main().name(), report, {}}};
    EXPECT_NE(io::lint_json(reported).find("\"slow-feed\""), std::string::npos);
    EXPECT_NE(io::lint_text(reported).find("below 1200 mm/min [slow-feed]"), std::string::npos);
    EXPECT_NE(io::lint_sarif(reported).find("slower than our machines"), std::string::npos);
}

}  // namespace
}  // namespace clsurf::own_lint_rule_test
