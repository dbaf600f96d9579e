#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulation/plan/speed_scan.h"

namespace clsurf::speed_scan_test {
namespace {

double time_of(const SpeedScan& scan) {
    std::vector<CellMotion> motions;
    double time = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        scan.motions(i, motions);
        for (const CellMotion& motion : motions) time += motion.duration();
    }
    return time;
}

// 100 mm at 50 mm/s, a = 2000: L/v + v/a.
TEST(SpeedScan, ALineIsDrivenUpAndDownAgain) {
    SpeedScan scan;
    scan.add_cell(100, 50, 2000);
    scan.plan(0);
    EXPECT_NEAR(time_of(scan), 2.025, 1e-12);
    // 1 mm at 1000 mm/s: 2 √(L/a).
    scan.clear();
    scan.add_cell(1, 1000, 2000);
    scan.plan(0);
    EXPECT_NEAR(time_of(scan), 2 * std::sqrt(1.0 / 2000), 1e-9);
}

// A bend with 20 mm/s between two lines of 10 mm: each is run from or to rest, with v² = 20² + 2 a s.
TEST(SpeedScan, BrakesBeforeWhatIsSlower) {
    SpeedScan scan;
    scan.add_cell(10, 1000, 2000);
    scan.add_cell(1, 20, 2000);
    scan.add_cell(10, 1000, 2000);
    scan.plan(0);
    EXPECT_DOUBLE_EQ(scan.speed(1), 20);
    EXPECT_DOUBLE_EQ(scan.speed(2), 20);
    const double peak = std::sqrt(0.5 * 400 + 2000 * 10);
    EXPECT_NEAR(time_of(scan), 2 * (peak + (peak - 20)) / 2000 + 1.0 / 20, 1e-12);
}

// 1 mm before a bend with |a + 0.1 b| ≤ 1000, b is at most 3000 at the bend. The hardest braking is a = −1000 − 0.1 b, and
// b + 2 a = 3000 gives b = 6250, a = −1625.
TEST(SpeedScan, ABendLeavesLessOrMoreForBraking) {
    SpeedScan scan;
    scan.add_cell(10, 1000, 2000);
    scan.add_cell(1, 1000, 2000);
    scan.add_limit(0, 1, 0.1, 1000);
    scan.add_cell(10, std::sqrt(3000), 2000);
    scan.plan(0);
    EXPECT_NEAR(scan.speed(1), std::sqrt(6250), 1e-9);
    EXPECT_NEAR(scan.speed(2), std::sqrt(3000), 1e-9);
}

// Where an axis reverses, its slope is zero: 0.1 b ≤ 1000 for any acceleration.
TEST(SpeedScan, AnAxisThatTurnsBackCapsTheSpeed) {
    SpeedScan scan;
    scan.add_cell(10, 1000, 2000);
    scan.add_cell(1, 1000, 2000);
    scan.add_limit(0, 0, 0.1, 1000);
    scan.add_cell(10, 1000, 2000);
    scan.plan(0);
    EXPECT_NEAR(scan.speed(1), 100, 1e-9);
}

TEST(SpeedScan, ForgetsCellsAndGoesOnAsPlanned) {
    SpeedScan scan;
    for (int i = 0; i < 40; ++i) {
        scan.add_cell(0.5, 200, 2000);
        scan.add_limit(0.25, std::cos(0.3 * i), 0.2 * std::sin(0.5 * i), 1500);
    }
    scan.plan(0);
    std::vector<double> speeds;
    for (std::size_t i = 0; i <= scan.size(); ++i) speeds.push_back(scan.speed(i));
    scan.drop_front(15);
    scan.plan(speeds[15]);
    ASSERT_EQ(scan.size(), 25U);
    for (std::size_t i = 0; i <= scan.size(); ++i) EXPECT_NEAR(scan.speed(i), speeds[15 + i], 1e-9) << i;
}

// A limit that is added to a cell in the middle only affects that cell: the speeds are those of a scan that had it from the
// beginning.
TEST(SpeedScan, ALimitJoinsAnyCell) {
    SpeedScan whole, joined;
    for (int i = 0; i < 40; ++i) {
        for (SpeedScan* scan : {&whole, &joined}) {
            scan->add_cell(0.5, 200, 2000);
            scan->add_limit(0.25, std::cos(0.3 * i), 0.2 * std::sin(0.5 * i), 1500);
        }
        if (i == 17) whole.add_limit(0.4, 0.5, 1.5, 1500);
    }
    joined.plan(0);
    const double before = joined.speed(18);
    joined.add_limit(17, 0.4, 0.5, 1.5, 1500);
    joined.plan(0);
    whole.plan(0);
    EXPECT_LT(joined.speed(18), 0.95 * before);
    for (std::size_t i = 0; i <= whole.size(); ++i) EXPECT_EQ(joined.speed(i), whole.speed(i)) << i;
    const double here =
        0.5 * joined.acceleration(17) + 1.5 * (joined.speed(17) * joined.speed(17) + 2 * joined.acceleration(17) * 0.4);
    EXPECT_LE(std::abs(here), 1500 * (1 + 1e-9));
}

// Random bends: all limits are met along the cells, no knot can be faster with the neighbours unchanged, and the reverse
// path has the same speeds.
TEST(SpeedScan, HoldsItsLimitsIsTightAndTheSameBackwards) {
    std::mt19937_64 random(7);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    constexpr std::size_t cells = 300;
    constexpr double steepest = 2000, limit = 1500;
    struct Place {
        double at, slope, bend;
    };
    std::vector<double> lengths, caps;
    std::vector<Place> places;
    double bend = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        lengths.push_back(uniform(0.05, 0.3));
        caps.push_back(i % 40 == 0 ? 60 : 150);
        bend = 0.9 * bend + uniform(-0.03, 0.03);
        places.push_back({0.5 * lengths.back(), 0.75 + 0.25 * std::cos(0.05 * static_cast<double>(i)), bend});
    }
    SpeedScan scan, back;
    for (std::size_t i = 0; i < cells; ++i) {
        scan.add_cell(lengths[i], caps[i], steepest);
        scan.add_limit(places[i].at, places[i].slope, places[i].bend, limit);
        const std::size_t k = cells - 1 - i;
        back.add_cell(lengths[k], caps[k], steepest);
        back.add_limit(lengths[k] - places[k].at, -places[k].slope, places[k].bend, limit);
    }
    scan.plan(0);
    back.plan(0);
    const auto holds = [&](std::size_t i, double before, double after) {
        const double a = 0.5 * (after - before) / lengths[i];
        const double here = places[i].slope * a + places[i].bend * (before + 2 * a * places[i].at);
        return std::max(before, after) <= caps[i] * caps[i] * (1 + 1e-9) && std::abs(a) <= steepest * (1 + 1e-9) &&
               std::abs(here) <= limit * (1 + 1e-9);
    };
    for (std::size_t i = 0; i < cells; ++i) {
        const double before = scan.speed(i) * scan.speed(i), after = scan.speed(i + 1) * scan.speed(i + 1);
        EXPECT_TRUE(holds(i, before, after)) << i;
        EXPECT_NEAR(back.speed(cells - i), scan.speed(i), 1e-6 * scan.speed(i)) << i;
        if (i == 0) continue;
        const double earlier = scan.speed(i - 1) * scan.speed(i - 1);
        const double faster = before * (1 + 1e-5);
        EXPECT_FALSE(holds(i - 1, earlier, faster) && holds(i, faster, after)) << i;
    }
}

}  // namespace
}  // namespace clsurf::speed_scan_test
