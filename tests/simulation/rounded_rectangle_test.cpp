// The rounded rectangle of Li et al., Optimal Control of CNC Machining Tool Motion in Green Converter PathSample
// Based on Multisensor Fusion Data, Sensors and Materials (2025): its times and its Fig. 5.
// docs/experiments/rounded_rectangle.md explains which of the printed numbers cannot be right. mm, s.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "simulation/path/junction.h"
#include "simulation/path/transition_arc.h"
#include "simulation/plan/scurve.h"

namespace clsurf::rounded_rectangle_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr double jerk = 300;
constexpr double mm_s(double m_min) { return m_min * 1000 / 60; }
constexpr double at_b = mm_s(0.19), fast = mm_s(1.26), at_k = mm_s(0.13);
constexpr double arc_length_ab = 22.92;
constexpr double lap = 4 * 400 + 2 * std::numbers::pi * 5;

/// No acceleration limit: the five phases of the paper.
SCurve profile(double arc_length, double start, double end, double speed) {
    return plan_scurve(arc_length, start, end, {speed, none, none, jerk}).profile;
}

TEST(RoundedRectangle, HalfRampsAreWhatThePaperPrintsAsRamps) {
    EXPECT_NEAR(profile(arc_length_ab, 0, at_b, at_b).durations()[0], 0.102740233383, 1e-9);  // printed 0.10
    EXPECT_NEAR(profile(lap, at_b, at_k, fast).durations()[0], 0.243812313972, 1e-9);         // printed 0.24
    EXPECT_NEAR(profile(lap, at_b, at_k, fast).durations()[4], 0.25055493964, 1e-9);          // printed 0.25
    EXPECT_NEAR(ramp_time(at_b, none, jerk), 2 * 0.102740233383, 1e-9);
}

TEST(RoundedRectangle, LapAndTotals) {
    EXPECT_NEAR(lap, 1631.41592654, 1e-6);
    const SCurve round = profile(lap, at_b, at_k, fast);
    EXPECT_NEAR(round.durations()[3], 77.1294891832, 1e-6);
    EXPECT_NEAR(round.length() - ramp_distance(at_b, fast, none, jerk) - ramp_distance(fast, at_k, none, jerk), 1619.72,
                0.01);
    EXPECT_NEAR(profile(arc_length_ab, 0, at_b, at_b).duration() + round.duration(), 85.4588586606, 1e-6);
    EXPECT_NEAR(profile(arc_length_ab, at_k, at_b, at_b).duration() + round.duration(), 85.374350541,
                1e-6);  // printed 85.38
    // The initial acceleration as a state of the machine, reduced under the jerk limit.
    const RunningRamp running = ramp_from_state(at_k, 20, at_b, none, jerk);
    EXPECT_NEAR(running.time(), 0.0824045318333, 1e-9);
    EXPECT_NEAR(running.time() + (arc_length_ab - running.arc_length) / at_b + round.duration(), 85.3649383333, 1e-6);
}

TEST(RoundedRectangle, TheRadiusDoesNotBearTheSpeedUnderItsOwnJerkLimit) {
    constexpr double radius = 5;
    EXPECT_NEAR(fast * fast * fast / (radius * radius), 370.4, 0.1);
    EXPECT_NEAR(std::cbrt(jerk * radius * radius) * 60 / 1000, 1.17, 0.01);
}

// Fig. 5: the lowest of three speeds over the interior angle 2θ; the radius follows from E_rr minus the chord error.
TEST(RoundedRectangle, ThreeArcLengthMinimumAtACorner) {
    constexpr double contour_error = 0.002, chord_error = 0.0009, acceleration = 600, period = 0.001;
    struct Row {
        double angle, radius, one_period, chord, arc;
    };
    constexpr Row rows[] = {{10, 0.000105024834478, 0.209250366551, 0.210049668957, 0.251027689084},
                            {30, 0.000384118004829, 0.742059002415, 0.768236009659, 0.480073747353},
                            {60, 0.0011, 1.90525588833, 2.16333076528, 0.812403840464},
                            {90, 0.00265563491861, 3.75563491861, 3.98504346451, 1.26229194371},
                            {120, 0.00711051177665, 7.11051177665, 6.9250043171, 2.06550407068},
                            {150, 0.0311825142975, 16.1412571488, 14.8752849701, 4.32544894531},
                            {170, 0.287970361964, 50.1965415725, 45.4988637895, 13.1446649702}};
    const auto speeds = [&](double interior_deg) {
        const double deflection = std::numbers::pi * (1 - interior_deg / 180);
        const double radius = radius_at_error(deflection, contour_error - chord_error);
        return Row{interior_deg, radius, period_speed(radius, deflection, period),
                   chord_speed(radius, chord_error, period), arc_speed(radius, acceleration)};
    };
    for (const Row& row : rows) {
        const Row found = speeds(row.angle);
        EXPECT_NEAR(found.radius, row.radius, 1e-9 * row.radius) << row.angle;
        EXPECT_NEAR(found.one_period, row.one_period, 1e-6 * row.one_period) << row.angle;
        EXPECT_NEAR(found.chord, row.chord, 1e-6 * row.chord) << row.angle;
        EXPECT_NEAR(found.arc, row.arc, 1e-6 * row.arc) << row.angle;
        EXPECT_EQ(std::min({found.one_period, found.chord, found.arc}), row.angle > 14 ? found.arc : found.one_period);
    }
    const Row equal = speeds(13.966775445);
    EXPECT_NEAR(equal.one_period, equal.arc, 1e-6);
}

}  // namespace
}  // namespace clsurf::rounded_rectangle_test
