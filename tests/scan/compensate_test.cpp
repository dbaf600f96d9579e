// Corrected passes: measured excess height is removed at the contact point of the ball.
#include "scan/compensate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/readers/program_file.h"

namespace clsurf::compensate_test {
namespace {

Program program_of(const std::string& text) {
    const auto kept = std::make_shared<const std::string>(text);
    return io::read_program(io::Source{"pass.ngc", std::as_bytes(std::span(kept->data(), kept->size())), kept}, {});
}

std::string complaint(const std::string& text) {
    try {
        (void)pass_tips(program_of(text));
    } catch (const InputError& error) { return to_text(error.diagnostic()); }
    return "";
}

std::vector<ScanPoint> same_everywhere(double from, double to, double deviation) {
    std::vector<ScanPoint> points;
    for (int k = 0; k <= 40; ++k) points.push_back({from + (to - from) * k / 40, deviation});
    return points;
}

/// The tips of a ball on a slope.
std::vector<Vec2> slope(double rise) {
    std::vector<Vec2> tips;
    for (int k = 0; k <= 50; ++k) tips.emplace_back(k, rise * k);
    return tips;
}

TEST(PassTips, AreTheCutOfAProgramInRisingX) {
    const PassTips pass = pass_tips(program_of("G21 G90\nG0 X9 Y4 Z5\nG1 Z1 F500\nG1 X6 Z2\nX2 Z0\nG0 Z9\nM2\n"));
    EXPECT_DOUBLE_EQ(pass.y, 4);
    ASSERT_EQ(pass.places.size(), 3U);
    EXPECT_EQ(pass.places[0], Vec2(2, 0));
    EXPECT_EQ(pass.places[2], Vec2(9, 1));
}

TEST(PassTips, RefuseWhatIsNoPass) {
    const std::string begin = "G21 G90\nG0 X0 Y0 Z5\nG1 Z0 F500\nG1 X4\n";
    EXPECT_NE(complaint(begin + "G1 X5 Y1\nM2\n").find("pass.ngc:5: error: the pass leaves its plane"),
              std::string::npos);
    EXPECT_NE(complaint(begin + "G1 X3\nM2\n").find("the pass turns back in X at"), std::string::npos);
    EXPECT_NE(complaint(begin + "G18 G2 X6 Z0 R3\nM2\n").find("pass.ngc:5: error: the pass has an arc"),
              std::string::npos);
    EXPECT_NE(complaint("G21 G90\nG0 X1\nM2\n").find("has no pass at feed"), std::string::npos);
}

TEST(Compensate, TakesOffWhatIsTooHigh) {
    const Compensation made = compensate("dev.csv", same_everywhere(0, 50, 0.02), slope(0.1), {});
    for (const ScanPoint& point : made.target) EXPECT_NEAR(point.z, 0.1 * point.x - 0.02, 1e-12);
    EXPECT_NEAR(made.greatest, 0.02, 1e-12);
    EXPECT_NEAR(made.residuals.rms, 0, 1e-12);
}

TEST(Compensate, FindsTheProfileBelowABall) {
    // On a slope of 1:1 a ball of 4 mm touches 4/√2 mm ahead of its tip, and 4 − 4/√2 above it.
    CompensationRules rules;
    rules.radius = 4;
    const double ahead = 4 / std::sqrt(2.0);
    const Compensation made = compensate("dev.csv", same_everywhere(0, 60, -0.01), slope(1), rules);
    EXPECT_NEAR(made.target.front().x, ahead, 1e-9);
    for (const ScanPoint& point : made.target) EXPECT_NEAR(point.z, point.x - ahead + 4 - ahead + 0.01, 1e-9);
}

TEST(Compensate, RefusesAPassThatIsTighterThanTheBall) {
    std::vector<Vec2> tips;
    for (int k = 0; k <= 200; ++k)
        tips.emplace_back(0.1 * k, -0.25 * std::pow(0.1 * k - 10, 2));  // over a crest of radius 2 mm
    CompensationRules rules;
    rules.radius = 5;
    EXPECT_THROW((void)compensate("dev.csv", same_everywhere(-20, 40, 0), tips, rules), InputError);
    rules.radius = 1;
    EXPECT_NO_THROW((void)compensate("dev.csv", same_everywhere(-20, 40, 0), tips, rules));
}

TEST(Compensate, RefusesAPassThatGoesOnWithoutDeviations) {
    EXPECT_THROW((void)compensate("dev.csv", same_everywhere(0, 40, 0), slope(0), {}), InputError);
    EXPECT_THROW((void)compensate("dev.csv", std::vector<ScanPoint>{{0, 0}, {50, 0}}, slope(0), {}), InputError);
}

}  // namespace
}  // namespace clsurf::compensate_test
