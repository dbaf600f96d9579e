// Lint on small parts with one planted fault each.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lint/contact_places.h"
#include "lint/lint.h"
#include "lint/lint_rule.h"
#include "numeric/polyline.h"
#include "repair/parts.h"

namespace clsurf::lint_test {
namespace {

LintReport lint_text(const std::string& text, const LintThresholds& rules = {}) {
    const Program program = read_text(text);
    return lint(program, build_programmed_surface(program), rules);
}

/// Points spaced 0.3 mm apart.
double even(int, double) { return 0.3; }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(Lint, FindsNothingInAnEvenProgram) {
    LintThresholds rules;
    rules.tolerance = 0.02;
    const LintReport report = lint_text(wavy_zigzag(9, 12, even), rules);
    EXPECT_EQ(report.warnings(), 0U);
    EXPECT_EQ(report.passes, 9);
    EXPECT_NEAR(report.step_over, 0.4, 0.05);
}

TEST(Lint, FindsCrowdedPointsOnThePassThatHasThem) {
    const LintReport report =
        lint_text(wavy_zigzag(9, 12, [](int pass, double x) { return pass == 4 && x > 4 && x < 8 ? 0.03 : 0.3; }));
    ASSERT_GE(report.count("point-spacing"), 1U);
    const LintFinding& found = *std::max_element(report.findings.begin(), report.findings.end(),
                                                 [](const LintFinding& a, const LintFinding& b) {
                                                     return a.last_line - a.first_line < b.last_line - b.first_line;
                                                 });
    EXPECT_EQ(found.pass, 5);
    EXPECT_NEAR(found.found, 0.03, 0.01);
    EXPECT_NEAR(found.expected, 0.3, 0.1);
    EXPECT_GT(found.last_line - found.first_line, 80U);
}

TEST(Lint, ChordErrorIsHeldAgainstTheProgramsTolerance) {
    // Curvature at most 0.8 · 0.9² = 0.65 /mm: 0.3 mm have a chord error of 7.3 µm, more than 5/1.1.
    const LintReport report = lint_text(wavy_zigzag(5, 12, even));
    EXPECT_DOUBLE_EQ(report.tolerance, 0.005);
    EXPECT_GT(report.count("chord-error"), 0U);
    EXPECT_NEAR(report.chord_error, 0.0073, 0.001);
    LintThresholds wide;
    wide.tolerance = 0.1;
    const LintReport blurred = lint_text(wavy_zigzag(5, 12, even), wide);
    ASSERT_EQ(blurred.count("chord-error"), 1U);
    EXPECT_EQ(blurred.findings.front().severity, Severity::note);
}

TEST(Lint, FindsALineThatRunsBack) {
    std::string text = wavy_zigzag(5, 12, even);
    text.insert(text.find('\n', text.find("X3.0000")) + 1, "X2.9500\n");
    const LintReport report = lint_text(text);
    ASSERT_EQ(report.count("reversed-segment"), 1U);
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [](const LintFinding& f) { return f.rule->name == "reversed-segment"; });
    EXPECT_EQ(read_text(text).main().line(found->first_line).substr(0, 7), "X2.9500");
}

TEST(Lint, FindsAFeedThatOnlyOnePassHas) {
    std::string text = wavy_zigzag(7, 12, even);
    text = replaced(text, "Y1.2000", "Y1.2000 F2000");
    text = replaced(text, "Y1.6000", "Y1.6000 F3000");
    const LintReport report = lint_text(text);
    ASSERT_EQ(report.count("feed-difference"), 1U);
    EXPECT_EQ(report.findings.back().pass, 4);
    EXPECT_NEAR(report.findings.back().found, 2000.0 / 60, 1e-3);
}

TEST(Lint, KnowsTheStepOverOfLinesAHundredTimesAsLong) {
    std::string text = "G21 G90\nG0 X0 Y0 Z0\nG1 F3000\n";
    for (int pass = 0; pass < 12; ++pass)
        text += fmt::format("G1 Y{:.1f} F3000\nX{} F{}\n", 0.3 * pass, pass % 2 == 0 ? 30 : 0, pass == 5 ? 2400 : 3000);
    const LintReport report = lint_text(text);
    EXPECT_TRUE(report.judged());
    EXPECT_EQ(report.passes, 12);
    EXPECT_NEAR(report.step_over, 0.3, 0.01);
    ASSERT_EQ(report.count("feed-difference"), 1U);
    EXPECT_EQ(report.findings.back().pass, 6);
}

TEST(Lint, SinglePassHasNothingBesideIt) {
    const LintReport report = lint_text("G0 X0 Y0 Z0\nG1 X10 F1000\nX20\n");
    EXPECT_EQ(report.step_over, 0);
    EXPECT_EQ(report.warnings(), 0U);
}

TEST(Polyline, CurvatureOfThreePoints) {
    EXPECT_NEAR(three_point_curvature({5, 0, 0}, {0, 5, 0}, {-5, 0, 0}), 0.2, 1e-12);
    EXPECT_EQ(three_point_curvature({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0);
    EXPECT_TRUE(std::isinf(three_point_curvature({0, 0, 0}, {1, 0, 0}, {0.5, 0, 0})));
    EXPECT_TRUE(std::isinf(three_point_curvature({0, 0, 0}, {1, 0, 0}, {0, 0, 0})));
    EXPECT_NEAR(chord_error_of(2, 0.1, 0.1), 0.05, 1e-12);
}

TEST(Lint, AFindingIsWhereTheBallTouchesThePart) {
    const Program program =
        read_text(wavy_zigzag(9, 12, [](int pass, double x) { return pass == 4 && x > 4 && x < 8 ? 0.03 : 0.3; }));
    const ProgrammedSurface programmed = build_programmed_surface(program);
    LintReport report = lint(program, programmed);
    ASSERT_GE(report.findings.size(), 1U);
    add_contacts(report, program, programmed, parse_tool("ball:6"));
    for (const LintFinding& finding : report.findings) {
        // The tips are on z = 0.8 sin(0.9 x + 0.1 y), whose normal is also that of the part.
        const Vec3& tip = finding.place.tip;
        const double slope = 0.8 * std::cos(0.9 * tip.x() + 0.1 * tip.y());
        const Vec3 normal = Vec3(-0.9 * slope, -0.1 * slope, 1).normalized();
        ASSERT_TRUE(finding.place.contact);
        EXPECT_LT((*finding.place.contact - (tip + 3 * (Vec3::UnitZ() - normal))).norm(), 0.05);
    }
}

}  // namespace
}  // namespace clsurf::lint_test
