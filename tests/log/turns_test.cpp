#include "log/turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "log/quantum.h"
#include "support/made_columns.h"

namespace clsurf::turns_test {
namespace {

using test::log_of_columns;

double within(double angle, double low) { return angle - 360 * std::floor((angle - low) / 360); }

/// Three turns forward and back from 10 deg, at up to 1 deg per record.
std::vector<double> turning() {
    std::vector<double> angles;
    for (int i = 0; i < 4000; ++i) angles.push_back(10 + 550 * (1 - std::cos(0.0018 * i)));
    return angles;
}

std::vector<double> wrapped(std::vector<double> angles, double low) {
    for (double& angle : angles) angle = within(angle, low);
    return angles;
}

std::vector<double> read(const Log& log, std::string_view name) {
    std::vector<double> values(static_cast<std::size_t>(log.records));
    copy_block(log.find(name)->values, 0, values);
    return values;
}

void expect_same(const std::vector<double>& values, const std::vector<double>& expected) {
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], expected[i], 1e-9) << i;
}

TEST(Turns, PositionsOfAModuloAxisCountOn) {
    for (const double low : {0.0, -180.0}) {
        Log log = log_of_columns(0.002, {{"cmd.c", wrapped(turning(), low)}, {"cmd.x", turning()}});
        count_turns_on(log);
        expect_same(read(log, "cmd.c"), turning());
        expect_same(read(log, "cmd.x"), turning());
        ASSERT_EQ(log.diagnostics.count("log.modulo"), 1u);
    }
}

TEST(Turns, AllRolesOfAnAxisAreInTheSameTurn) {
    // The encoder starts on the other side of the end of the turn.
    std::vector<double> commanded = turning(), measured = turning();
    for (double& angle : commanded) angle -= 10;
    for (double& angle : measured) angle -= 10.003;
    Log log = log_of_columns(0.002, {{"fb.c", wrapped(measured, 0)}, {"cmd.c", wrapped(commanded, 0)}});
    count_turns_on(log);
    expect_same(read(log, "cmd.c"), commanded);
    expect_same(read(log, "fb.c"), measured);
}

TEST(Turns, OtherJumpsStay) {
    std::vector<double> lost, above;
    for (int i = 0; i < 1000; ++i) {
        lost.push_back(i < 500 ? 0.01 * i : 300 + 0.01 * i);  // records are lost
        above.push_back(i < 500 ? 0.1 * i : 359 + 0.1 * i);   // more than a turn
    }
    Log log = log_of_columns(0.002, {{"cmd.a", lost}, {"cmd.b", above}});
    count_turns_on(log);
    expect_same(read(log, "cmd.a"), lost);
    expect_same(read(log, "cmd.b"), above);
    EXPECT_EQ(log.diagnostics.count("log.modulo"), 0u);
}

TEST(Turns, AMissingPositionIsPassedOver) {
    std::vector<double> angles = turning();
    angles[2000] = std::numeric_limits<double>::quiet_NaN();
    Log log = log_of_columns(0.002, {{"cmd.c", wrapped(angles, 0)}});
    count_turns_on(log);
    const std::vector<double> read_again = read(log, "cmd.c");
    EXPECT_TRUE(std::isnan(read_again[2000]));
    EXPECT_NEAR(read_again[3999], angles[3999], 1e-9);
}

TEST(Turns, TheStepThatPositionsAreRoundedToIsStillKnown) {
    // Numbers of 32 bits near 360 deg: their last place is 2^-15 deg.
    std::vector<double> floats = wrapped(turning(), 0);
    for (double& angle : floats) angle = static_cast<double>(static_cast<float>(angle));
    Log log = log_of_columns(0.002, {{"cmd.c", floats}});
    count_turns_on(log);
    EXPECT_GE(resolution_of(log.find("cmd.c")->values), std::ldexp(1.0, -15));

    // Counts of an encoder: 2^28 per turn.
    const double step = std::ldexp(360.0, -28);
    std::vector<std::int32_t> counts;
    for (const double angle : wrapped(turning(), 0)) counts.push_back(static_cast<std::int32_t>(angle / step));
    log = log_of_columns(0.002, {{"cmd.c", floats}});
    log.channels[0].values = {
        reinterpret_cast<const std::byte*>(counts.data()), 4, log.records, ScalarType::i32, false, step, 0};
    count_turns_on(log);
    EXPECT_EQ(log.diagnostics.count("log.modulo"), 1u);
    EXPECT_DOUBLE_EQ(resolution_of(log.find("cmd.c")->values), step);
    EXPECT_NEAR(log.find("cmd.c")->values.at(1700), turning()[1700], step);
}

}  // namespace
}  // namespace clsurf::turns_test
