#include "limits/judge_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "limits/limit_budget.h"
#include "log/quantum.h"
#include "program/interpreter.h"

namespace clsurf::judge_limits_test {
namespace {

constexpr double period = 0.001;
constexpr double micrometre_step = 1e-6;  // [mm] resolution of a kernel's positions
using Positions = std::vector<Vec3>;

/// A log of commanded positions, rounded to `step`, optionally with a clock.
Log log_of(const Positions& positions, double step = micrometre_step, const std::vector<double>& times = {}) {
    auto columns = std::make_shared<std::vector<std::vector<double>>>(4);
    Log log;
    log.name = "made";
    log.period = period;
    log.records = static_cast<PointIndex>(positions.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const Vec3& p : positions) {
            const double value = p[static_cast<Eigen::Index>(axis)];
            (*columns)[axis].push_back(step > 0 ? std::round(value / step) * step : value);
        }
    }
    (*columns)[3] = times;
    const std::array<std::string, 4> names{"cmd.x", "cmd.y", "cmd.z", "time"};
    for (std::size_t c = 0; c < (times.empty() ? 3U : 4U); ++c) {
        log.channels.push_back({names[c], c < 3 ? "mm" : "s", view_of((*columns)[c])});
    }
    log.keep_alive = columns;
    return log;
}

Program empty_program() {
    auto text = std::make_shared<std::string>("M30\n");
    return parse_program(SourceText("part.nc", *text, text), {});
}

LimitReport judged(const Log& log, const std::vector<StatedLimit>& limits) {
    const Program program = empty_program();
    const Trajectory path = reconstruct(log, Role::commanded, Vec3(Vec3::Zero()));
    const auto n = static_cast<std::size_t>(log.records);
    const LineMap lines(Column<std::uint32_t>(n, LineMap::no_motion), Column<std::uint8_t>(n, std::uint8_t{0}),
                        program);
    return judge_limits(LimitedRun{log, path, program, lines}, limits);
}

constexpr double slow = 1.23456789;  // [mm/s] not a multiple of the resolution per period

/// Motion along x: pairs of an acceleration [mm/s²] and a number of records, starting at `speed` [mm/s].
Positions driven(const std::vector<std::pair<double, int>>& accelerations, double speed = slow,
                 const Vec3& along = Vec3::UnitX()) {
    Positions positions;
    double s = 0;
    // A second difference of the positions is the acceleration, exactly.
    for (const auto& [acceleration, records] : accelerations) {
        for (int i = 0; i < records; ++i) {
            positions.push_back(s * along);
            speed += acceleration * period;
            s += speed * period;
        }
    }
    return positions;
}

const StatedLimit acceleration_of_x{LimitedQuantity::acceleration, 'x', 2000};

TEST(JudgeLimits, APlateauAtTheLimitIsNoFinding) {
    const Log log = log_of(driven({{0, 200}, {2000, 100}, {0, 200}, {-2000, 100}, {0, 200}}));
    const LimitReport report = judged(log, {acceleration_of_x, {LimitedQuantity::speed, 'x', 200 + slow}});
    EXPECT_TRUE(report.findings.empty());
    ASSERT_EQ(report.judged.size(), 2u);
    EXPECT_NEAR(report.judged[0].factor, 1, 0.0011);
    // Three roundings of 5e-7 mm: 2e-6 mm / (1 ms)² relative to 2000 mm/s².
    EXPECT_NEAR(report.judged[0].uncertainty, 0.001, 1e-6);
    EXPECT_NEAR(report.judged[1].factor, 1, 1e-5);
    EXPECT_LE(report.greatest_factor(), 1);
}

TEST(JudgeLimits, WhatTheArithmeticOfAPlannerAddsIsNoFinding) {
    const auto findings = [](double over) {
        const Positions positions = driven({{0, 200}, {2000 * (1 + over), 100}, {0, 200}});
        return judged(log_of(positions, 0), {acceleration_of_x}).findings.size();
    };
    EXPECT_EQ(findings(1e-7), 0u);
    EXPECT_EQ(findings(1e-4), 1u);
}

TEST(JudgeLimits, ABurstOfThreeRecordsIsFoundWithItsFactorAndDuration) {
    const Log log = log_of(driven({{0, 500}, {1000, 40}, {2500, 3}, {1000, 40}, {0, 500}}));
    const LimitReport report = judged(log, {acceleration_of_x});
    ASSERT_EQ(report.findings.size(), 1u);
    const LimitFinding& found = report.findings.front();
    EXPECT_NEAR(found.factor, 1.25, 0.0011);
    EXPECT_EQ(found.points.size(), 3);
    EXPECT_NEAR(found.duration, 0.003, 1e-12);
    // The step from record i to i + 1 is the first one with the new speed: the difference is that of record i.
    EXPECT_EQ(found.points.first, 540);
    EXPECT_NEAR(found.time, 0.001 * static_cast<double>(found.point), 1e-12);
    EXPECT_DOUBLE_EQ(report.greatest_factor(), found.factor);
}

TEST(JudgeLimits, SpeedAndJerkAreDifferencesToo) {
    // The acceleration increases by 100 mm/s² in each period: a jerk of 100,000 mm/s³, for 10 records. The speed increases by
    // 100·0.001·(1 + … + 10) + 1000·0.001·20 + 100·0.001·(9 + … + 1) = 30 mm/s.
    std::vector<std::pair<double, int>> ramp{{0, 300}};
    for (int i = 1; i <= 10; ++i) ramp.emplace_back(100.0 * i, 1);
    ramp.insert(ramp.end(), {{1000, 20}, {0, 0}});
    for (int i = 9; i >= 0; --i) ramp.emplace_back(100.0 * i, i == 0 ? 300 : 1);
    const Log log = log_of(driven(ramp));
    const LimitReport report =
        judged(log, {{LimitedQuantity::jerk, 'x', 80000}, {LimitedQuantity::speed, 'x', 25}, acceleration_of_x});
    ASSERT_EQ(report.findings.size(), 3u) << "the rise, the fall, the speed";
    EXPECT_EQ(report.findings[0].limit.quantity, LimitedQuantity::jerk);
    EXPECT_NEAR(report.findings[0].factor, 1.25, 0.01);
    EXPECT_EQ(report.findings[0].points.size(), 10);
    EXPECT_EQ(report.findings[2].limit.quantity, LimitedQuantity::speed);
    EXPECT_NEAR(report.findings[2].value, 30 + slow, 1e-3);
}

TEST(JudgeLimits, APathTakesWhatEachAxisMay) {
    // Diagonal: 1500 in each axis is 2121 along the path.
    const Log log = log_of(driven({{0, 100}, {1500 * std::sqrt(2.0), 50}, {0, 100}}, slow, Vec3(1, 1, 0).normalized()));
    const LimitReport report = judged(log, {acceleration_of_x, {LimitedQuantity::tangential_acceleration, 0, 2000}});
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_EQ(axis_name(report.findings[0].limit), "path");
    EXPECT_NEAR(report.findings[0].factor, 1.5 / std::sqrt(2.0), 0.003);
}

TEST(JudgeLimits, ACircleHasNormalAccelerationOnly) {
    // 50 mm/s on a radius of 1 mm: v²/r = 2500 mm/s². A second difference shows sinc²(ωT/2) of it, 0.02 % less.
    Positions positions;
    for (int i = 0; i < 1000; ++i) positions.emplace_back(std::cos(0.05 * i), std::sin(0.05 * i), 0);
    const LimitReport report = judged(log_of(positions), {{LimitedQuantity::normal_acceleration, 0, 2000},
                                                          {LimitedQuantity::tangential_acceleration, 0, 2000},
                                                          {LimitedQuantity::path_jerk, 0, 50000}});
    ASSERT_EQ(report.findings.size(), 1u) << "one run";
    EXPECT_EQ(report.findings[0].limit.quantity, LimitedQuantity::normal_acceleration);
    EXPECT_NEAR(report.findings[0].factor, 1.25, 0.002);
    EXPECT_EQ(report.findings[0].points.size(), 998);
}

TEST(JudgeLimits, ACornerAtSpeedChangesNoSpeedAlongThePath) {
    // A corner of 90° at 20 mm/s within a period: the chord across it is 29 % shorter.
    Positions positions;
    for (int i = 0; i < 100; ++i) positions.emplace_back(0.02 * i - 1.99, 0, 0);
    for (int i = 0; i < 100; ++i) positions.emplace_back(0, 0.01 + 0.02 * i, 0);
    const LimitReport report = judged(
        log_of(positions), {{LimitedQuantity::tangential_acceleration, 0, 2000}, {LimitedQuantity::path_jerk, 0, 1e6}});
    EXPECT_TRUE(report.findings.empty());
}

// Deceleration to a stop in a sharp corner and acceleration away from it. The corner is between records, and the path is
// straight.
TEST(JudgeLimits, AStopInASharpCornerIsNoNormalAcceleration) {
    constexpr double limit = 2000, braking = 3800;
    for (int degrees = 91; degrees < 180; degrees += 4) {
        const double turn = degrees * rad_per_deg;
        const Vec3 out(std::cos(turn), std::sin(turn), 0);
        for (double phase = 0; phase < 1; phase += 0.05) {
            Positions positions;
            for (int i = 0; i < 40; ++i) {
                const double t = (i - 20 - phase) * period, way = 0.5 * braking * t * t;
                positions.push_back(t < 0 ? Vec3(-way, 0, 0) : Vec3(way * out));
            }
            const LimitReport report = judged(log_of(positions, 0), {{LimitedQuantity::normal_acceleration, 0, limit}});
            EXPECT_TRUE(report.findings.empty()) << degrees << " deg, phase " << phase;
        }
    }
}

TEST(JudgeLimits, ASharpCornerAtSpeedIsNormalAcceleration) {
    // 120° within a period: the velocity changes by √3 of the speed.
    constexpr double speed = 16 * slow, step = speed * period;
    const Vec3 out(-0.5, 0.5 * std::sqrt(3.0), 0);
    Positions positions;
    for (int i = 0; i < 100; ++i) positions.emplace_back(step * (i - 99), 0, 0);
    for (int i = 1; i < 100; ++i) positions.push_back(step * i * out);
    const LimitReport report = judged(log_of(positions), {{LimitedQuantity::normal_acceleration, 0, 2000}});
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_NEAR(report.findings[0].factor, std::sqrt(3.0) * speed / period / 2000, 0.01);
}

TEST(JudgeLimits, CoarsePositionsAreLookedAtOverMoreRecords) {
    // Steps of 0.1 µm and 1 ms: a rounding error of 200 mm/s², a tenth of the limit. 20 records at 1.2 times the limit are
    // found.
    const Log log = log_of(driven({{0, 300}, {2000, 100}, {2400, 20}, {2000, 100}, {0, 300}}), 1e-4);
    const LimitReport report = judged(log, {acceleration_of_x});
    ASSERT_FALSE(report.findings.empty());
    EXPECT_NEAR(report.findings.front().factor, 1.2, 0.02);
    for (const LimitFinding& found : report.findings) {
        EXPECT_GE(found.point, 400 - 8);
        EXPECT_LE(found.point, 420 + 8);
    }
    const Log clean = log_of(driven({{0, 300}, {2000, 120}, {0, 300}, {-1999, 120}, {0, 300}}), 1e-4);
    EXPECT_TRUE(judged(clean, {acceleration_of_x, {LimitedQuantity::jerk, 'x', 2.1e6}}).findings.empty());
}

Positions even(int records) {
    Positions positions;
    for (int i = 0; i < records; ++i) positions.emplace_back(0.0512345678 * i, 0.02345678 * i, 0);
    return positions;
}
const std::vector<StatedLimit> all_limits{acceleration_of_x,
                                          {LimitedQuantity::speed, 'x', 60},
                                          {LimitedQuantity::jerk, 'x', 50000},
                                          {LimitedQuantity::tangential_acceleration, 0, 2000},
                                          {LimitedQuantity::path_jerk, 0, 50000}};

TEST(JudgeLimits, LostRecordsAreNoFindings) {
    Positions positions = even(1000);
    positions.erase(positions.begin() + 700, positions.begin() + 740);
    positions.erase(positions.begin() + 400);
    positions.erase(positions.begin() + 398);
    positions.erase(positions.begin() + 200);
    const LimitReport report = judged(log_of(positions), all_limits);
    EXPECT_TRUE(report.findings.empty());
    EXPECT_GE(report.broken_steps, 4);
    EXPECT_EQ(report.diagnostics.count("limits.lost-records"), 1u);
}

TEST(JudgeLimits, RepeatedRecordsAreNoFindings) {
    Positions positions = even(1000);
    positions[300] = positions[299];                            // a stale sample
    positions.insert(positions.begin() + 600, positions[599]);  // a duplicate sample
    EXPECT_TRUE(judged(log_of(positions), all_limits).findings.empty());
}

TEST(JudgeLimits, ALostRecordNearStandstillIsNoFinding) {
    // Each of the records around a start, a stop and a reversal is lost in turn.
    const Positions whole = driven({{0, 50}, {2000, 20}, {-2000, 40}, {2000, 20}, {0, 50}}, 1e-4);
    ASSERT_TRUE(judged(log_of(whole), {acceleration_of_x}).findings.empty());
    for (std::ptrdiff_t lost = 45; lost < 135; ++lost) {
        Positions positions = whole;
        positions.erase(positions.begin() + lost);
        const LimitReport report = judged(log_of(positions), {acceleration_of_x});
        EXPECT_TRUE(report.findings.empty()) << lost << ": " << report.greatest_factor();
    }
}

/// From rest to rest: the jerk is 50,000 mm/s³ or zero, so the acceleration changes by 50 mm/s² per period.
Positions driven_smoothly(const Vec3& along) {
    std::vector<std::pair<double, int>> accelerations{{0, 20}};
    for (int i = 1; i <= 20; ++i) accelerations.emplace_back(50.0 * i, 1);
    for (int i = 19; i >= -20; --i) accelerations.emplace_back(50.0 * i, 1);
    for (int i = -19; i <= 0; ++i) accelerations.emplace_back(50.0 * i, 1);
    accelerations.emplace_back(0, 20);
    return driven(accelerations, 0, along);
}

TEST(JudgeLimits, ALostRecordOfASmoothStartIsNoJerk) {
    // Near standstill a lost record changes the acceleration by less than the limit, but the jerk by ten times its limit or
    // more.
    const std::vector<StatedLimit> limits{acceleration_of_x,
                                          {LimitedQuantity::acceleration, 'y', 2000},
                                          {LimitedQuantity::jerk, 'x', 50000},
                                          {LimitedQuantity::jerk, 'y', 50000},
                                          {LimitedQuantity::jerk, 'z', 50000}};
    const Positions whole = driven_smoothly(Vec3(0.8, 0.6, 0));
    ASSERT_TRUE(judged(log_of(whole), limits).findings.empty());
    for (std::ptrdiff_t at = 15; at < 115; ++at) {
        if (at == 21 || at == 97) continue;  // hardly more than three times the limit: that may be a violation
        Positions lost = whole, repeated = whole;
        lost.erase(lost.begin() + at);
        repeated.insert(repeated.begin() + at, whole[static_cast<std::size_t>(at)]);
        EXPECT_TRUE(judged(log_of(lost), limits).findings.empty()) << at;
        EXPECT_TRUE(judged(log_of(repeated), limits).findings.empty()) << at;
    }
}

TEST(JudgeLimits, AStepOfTheAccelerationIsNoLostRecord) {
    // Diagonal, so that both axes are at their limit from the first period on: 40 times the limit of the jerk.
    const std::vector<StatedLimit> limits{acceleration_of_x,
                                          {LimitedQuantity::jerk, 'x', 50000},
                                          {LimitedQuantity::jerk, 'y', 50000},
                                          {LimitedQuantity::jerk, 'z', 50000}};
    const double both = 2000 * std::sqrt(2.0);
    const LimitReport report = judged(
        log_of(driven({{0, 50}, {both, 20}, {0, 50}, {-both, 20}, {0, 50}}, slow, Vec3(1, 1, 0).normalized())), limits);
    EXPECT_EQ(report.broken_steps, 0);
    ASSERT_EQ(report.findings.size(), 8u) << "four steps, two axes";
    for (const LimitFinding& found : report.findings) EXPECT_NEAR(found.factor, 40, 0.1);
}

TEST(JudgeLimits, GapsOfTheClockAreNoFindings) {
    Positions positions = driven({{0, 100}, {1000, 100}, {-1000, 90}, {0, 100}});
    std::vector<double> times;
    for (std::size_t i = 0; i < positions.size(); ++i) times.push_back(period * static_cast<double>(i));
    positions.erase(positions.begin() + 103);
    times.erase(times.begin() + 103);
    EXPECT_TRUE(judged(log_of(positions, micrometre_step, times), {acceleration_of_x}).findings.empty());
}

/// Times of 1000 records, early or late by up to 5 % of a period. `turn` [rad]: phase per record.
std::vector<double> unsteady_times(double turn) {
    std::vector<double> times;
    for (int i = 0; i < 1000; ++i) times.push_back(period * (i + 0.05 * std::sin(turn * i)));
    return times;
}

/// The position of an axis that moves at 50 mm/s, accelerates by 2,400 mm/s² from 0.4 s on, and is at constant speed from
/// 0.42 s on.
double driven_to(double time) {
    const double since = std::clamp(time - 0.4, 0.0, 0.02), after = std::max(0.0, time - 0.42);
    return 50 * time + 1200 * since * since + 48 * after;
}

TEST(JudgeLimits, WhatAnUnsteadyClockExplainsIsNoFinding) {
    // Constant speed: with equal periods these would be accelerations of 600 mm/s² and jerks of 230,000 mm/s³, and with the
    // faster change accelerations of 5,000 mm/s².
    for (const double turn : {0.5, 2.0}) {
        const std::vector<double> times = unsteady_times(turn);
        Positions positions;
        for (const double time : times) positions.emplace_back(50 * time, 0, 0);
        const LimitReport report = judged(log_of(positions, micrometre_step, times), all_limits);
        EXPECT_TRUE(report.findings.empty()) << turn;
        for (const JudgedLimit& limit : report.judged)
            EXPECT_LE(limit.factor, 1) << turn << ' ' << words_of(limit.limit);
    }
}

TEST(JudgeLimits, AViolationUnderAnUnsteadyClockHasItsFactor) {
    const std::vector<double> times = unsteady_times(0.5);
    for (const bool stamps_only : {false, true}) {
        Positions positions;
        for (std::size_t i = 0; i < times.size(); ++i)
            positions.emplace_back(driven_to(stamps_only ? period * static_cast<double>(i) : times[i]), 0, 0);
        const LimitReport report = judged(log_of(positions, micrometre_step, times),
                                          {acceleration_of_x, {LimitedQuantity::tangential_acceleration, 0, 2000}});
        ASSERT_FALSE(report.findings.empty());
        for (const LimitFinding& found : report.findings) {
            EXPECT_LE(found.factor, 1.2 + found.uncertainty);
            EXPECT_GE(found.point, 400);
            EXPECT_LE(found.point, 420);
        }
        for (const JudgedLimit& limit : report.judged) EXPECT_NEAR(limit.factor, 1.2, 0.003) << words_of(limit.limit);
    }
}

TEST(JudgeLimits, WhatTheLogDoesNotHaveIsSaidAndNotJudged) {
    const LimitReport report =
        judged(log_of(even(100)), {{LimitedQuantity::speed, 'a', 1}, {LimitedQuantity::following_error, 'x', 0.01}});
    EXPECT_TRUE(report.judged.empty());
    EXPECT_EQ(report.diagnostics.count("limits.not-judged"), 2u);
    LimitBudget budget;
    budget.max_limit_factor = 1;
    EXPECT_FALSE(hold(report, budget).front().held) << "what is not known holds nothing";
}

TEST(Resolution, IsTheStepThatPositionsWereRoundedTo) {
    for (const double step : {1e-3, 1e-4, 1e-6}) {
        const Log log = log_of(driven({{0, 2000}, {777, 3000}}), step);
        EXPECT_NEAR(resolution_of(log.find("cmd.x")->values), step, 1e-3 * step);
    }
    // A 32-bit number near 1,000 mm as text: its last place is 2^-14 mm.
    Positions floats = driven({{0, 2000}, {777, 3000}});
    for (Vec3& p : floats) p.x() = static_cast<double>(static_cast<float>(p.x() + 1000));
    EXPECT_GE(resolution_of(log_of(floats, 0).find("cmd.x")->values), std::ldexp(1.0, -14));
    // The same with six decimals, as text.
    EXPECT_GE(resolution_of(log_of(floats, 1e-6).find("cmd.x")->values), std::ldexp(1.0, -14));
    EXPECT_LT(resolution_of(log_of(driven({{777, 3000}}), 0).find("cmd.x")->values), 1e-9);
}

}  // namespace
}  // namespace clsurf::judge_limits_test
