// Ramps: speeds around a lowered place that a machine can run.

#include "repair/feeds/ramp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clsurf::ramp_test {
namespace {

constexpr double period = 0.001;
constexpr Ramp ramp{1000, 50'000};  // 1 mm/s² a period² of bend is 0.05 mm/s

struct Segment {
    std::vector<float> own, speeds;
    std::vector<std::int32_t> causes;

    explicit Segment(std::size_t points, float speed = 50)
        : own(points, speed), speeds(points, speed), causes(points, -1) {}
    void lower(std::size_t i, float speed) {
        speeds[i] = speed;
        causes[i] = 3;
    }
    void keep(const Ramp& rules = ramp) { keep_to_ramp(rules, period, own, speeds, causes); }
};

// From a point lowered by 2 mm/s the speed increases by j t²/2 and then levels off symmetrically: half of the change after
// √(2/j) s, 6.3 points, all after twice that; steps of a period take half a point more or less.
TEST(Ramp, LeavesALowPlaceAndComesBackByTheJerk) {
    Segment s(101);
    s.lower(50, 48);
    s.keep();
    EXPECT_FLOAT_EQ(s.speeds[50], 48);
    for (const int side : {-1, 1}) {
        EXPECT_NEAR(s.speeds[static_cast<std::size_t>(50 + 6 * side)], 49, 0.3);
        EXPECT_NEAR(s.speeds[static_cast<std::size_t>(50 + 12 * side)], 50, 0.1);
        EXPECT_FLOAT_EQ(s.speeds[static_cast<std::size_t>(50 + 16 * side)], 50);
    }
    EXPECT_EQ(s.causes[45], 3);
    EXPECT_EQ(s.causes[55], 3);
    EXPECT_EQ(s.causes[20], -1);
}

TEST(Ramp, BendsNoSharperThanTheJerkAndRisesNoFasterThanTheAcceleration) {
    Segment s(400);
    s.lower(60, 46);
    s.lower(90, 44);
    s.lower(97, 43);
    s.lower(200, 40);
    s.keep();
    const double bend = ramp.jerk * period * period;
    for (std::size_t i = 1; i + 1 < s.speeds.size(); ++i) {
        const double before = s.speeds[i] - s.speeds[i - 1], behind = s.speeds[i + 1] - s.speeds[i];
        // At a lowered place a step takes longer than a period, by 50/40 at most.
        EXPECT_LE(std::abs(before), ramp.acceleration * period * 1.25 + 1e-4) << i;
        // Peaks are rounded except for a thousandth of a speed, on each side.
        EXPECT_GE(behind - before, -1.25 * 1.25 * bend - 0.1) << i;
        ASSERT_LE(s.speeds[i], s.own[i]);
    }
    EXPECT_LT(s.speeds[93], 44.3) << "no peak between low places seven points apart";
}

TEST(Ramp, TakesPlacesThatAreFarApartEachForItself) {
    Segment both(2000), left(2000), right(2000);
    for (Segment* s : {&both, &left}) s->lower(300, 20);
    for (Segment* s : {&both, &right}) s->lower(1500, 30);
    for (Segment* s : {&both, &left, &right}) s->keep();
    for (std::size_t i = 0; i < both.speeds.size(); ++i)
        ASSERT_FLOAT_EQ(both.speeds[i], std::min(left.speeds[i], right.speeds[i])) << i;
    EXPECT_LT(both.speeds[330], 50);
    EXPECT_EQ(both.speeds[900], 50);
}

TEST(Ramp, LetsSpeedsChangeAsTheMachineDid) {
    Segment s(200);
    for (std::size_t i = 0; i < s.own.size(); ++i)
        s.own[i] = static_cast<float>(40 + 10 * std::cos(0.1 * static_cast<double>(i)));
    s.speeds = s.own;
    s.causes.assign(s.causes.size(), 0);
    s.keep();
    EXPECT_EQ(s.speeds, s.own)
        << "10 · 0.1² = 0.1 mm/s a period² where the jerk gives 0.05: faster than the ramp, and not slowed";
}

TEST(Ramp, IsNoneWhereNothingIsLoweredOrNothingLimits) {
    Segment idle(50);
    idle.speeds[20] = 10;  // without a cause
    idle.keep();
    EXPECT_EQ(idle.speeds[21], 50);
    Segment free(50);
    free.lower(20, 10);
    free.keep({});
    EXPECT_EQ(free.speeds[21], 50);
}

TEST(Ramp, IsTheLeastOfAxesAndPath) {
    Machine machine;
    machine.axes[1].max_acceleration = 900;
    machine.axes[2].max_jerk = 0;  // not limited
    const Ramp least = ramp_of(machine);
    EXPECT_EQ(least.acceleration, 900);
    EXPECT_EQ(least.jerk, machine.path.max_jerk);
}

}  // namespace
}  // namespace clsurf::ramp_test
