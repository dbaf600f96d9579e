// Profiles and scan compared with independently computed vectors
// (tests/simulation/vectors): the tolerance of each is that of its source.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "simulation/plan/lookahead.h"
#include "simulation/plan/scurve.h"
#include "simulation/run/interpolator.h"
#include "support/vector_rows.h"

namespace clsurf::vectors_test {
namespace {

std::vector<VectorRow> rows(const std::string& file) { return vector_rows("simulation", file); }

void near(double value, double expected, double relative, double absolute, const std::string& what) {
    if (std::isnan(expected)) return;  // not given
    EXPECT_NEAR(value, expected, absolute + relative * std::abs(expected)) << what;
}

TEST(SCurveVectors, RampsAndReach) {
    for (VectorRow& r : rows("ramp_reach.txt")) {
        const double v0 = r.number(), v1 = r.number(), arc_length = r.number(), a = r.number(), j = r.number();
        near(ramp_time(std::abs(v1 - v0), a, j), r.number(), 1e-7, 1e-9, r.name);
        near(ramp_distance(v0, v1, a, j), r.number(), 1e-7, 1e-9, r.name);
        near(reach(v0, arc_length, a, j), r.number(), 1e-7, 1e-9, r.name);
    }
}

TEST(SCurveVectors, SevenPhasesWithUnequalEndSpeeds) {
    for (VectorRow& r : rows("scurve.txt")) {
        const double arc_length = r.number(), vs = r.number(), ve = r.number();
        RampLimits limits{r.number(), r.number(), r.number(), r.number()};
        const PlannedProfile plan = plan_scurve(arc_length, vs, ve, limits);
        const std::string status = r.word();
        const char* names[] = {"ok", "end_speed_lowered", "infeasible_decel"};
        EXPECT_EQ(names[static_cast<int>(plan.status)], status) << r.name;
        const double peak = r.number(), end = r.number();
        const std::vector<double> durations = r.numbers(7);
        const double time = r.number(), needed = r.number(), allowed = r.number();
        near(plan.needed_arc_length, needed, 1e-7, 1e-9, r.name);
        if (plan.status == ProfileStatus::infeasible_decel) {
            near(plan.allowed_start, allowed, 1e-7, 1e-9, r.name);
            continue;
        }
        near(plan.profile.peak_speed(), peak, 1e-7, 1e-9, r.name);
        near(plan.profile.end_speed(), end, 1e-7, 1e-9, r.name);
        // If the peak is found by iteration, the durations of flat ramps have the square root of its error.
        for (std::size_t i = 0; i < 7; ++i) near(plan.profile.durations()[i], durations[i], 1e-7, 1e-8, r.name);
        near(plan.profile.duration(), time, 1e-7, 1e-9, r.name);
        const int samples = static_cast<int>(r.number());
        for (int i = 0; i < samples; ++i) {
            const double t = r.number();
            const MotionState s = plan.profile.at(t);
            near(s.arc_length, r.number(), 1e-7, 1e-9, r.name);
            near(s.speed, r.number(), 1e-7, 1e-8, r.name);
            // Rounding the time to twelve digits changes the acceleration by the jerk times the rounding error.
            near(s.acceleration, r.number(), 1e-7, 1e-8 + limits.jerk * 1e-11, r.name);
        }
    }
}

TEST(SCurveVectors, RampFromARunningState) {
    for (VectorRow& r : rows("ramp_from_state.txt")) {
        const double v0 = r.number(), a0 = r.number(), v1 = r.number(), a = r.number(), j = r.number();
        const RunningRamp ramp = ramp_from_state(v0, a0, v1, a, j);
        for (const double d : ramp.durations) near(d, r.number(), 1e-8, 1e-9, r.name);
        const std::vector<double> jerks = r.numbers(3);
        for (std::size_t i = 0; i < 3; ++i) {
            if (ramp.durations[i] > 0) near(ramp.jerks[i], jerks[i], 1e-8, 1e-9, r.name);
        }
        near(ramp.time(), r.number(), 1e-8, 1e-9, r.name);
        near(ramp.arc_length, r.number(), 1e-8, 1e-9, r.name);
    }
}

// The five-phase profile of Li et al. 2025 is the seven-phase one without an acceleration limit.
TEST(SCurveVectors, FivePhasesOfLi) {
    for (VectorRow& r : rows("symmetric_model.txt")) {
        const double vs = r.number(), j = r.number(), t1 = r.number(), t2 = r.number(), t3 = r.number();
        const SCurve profile(vs, j, {t1, 0, t1, t3, t2, 0, t2});
        near(profile.duration(), r.number(), 1e-8, 1e-9, r.name);
        near(profile.end_speed(), r.number(), 1e-8, 1e-9, r.name);
        const int samples = static_cast<int>(r.number());
        for (int i = 0; i < samples; ++i) {
            const double t = r.number();
            near(profile.at(t).arc_length, r.number(), 1e-8, 1e-9, r.name);
        }
    }
    constexpr double none = std::numeric_limits<double>::infinity();
    for (VectorRow& r : rows("no_plateau.txt")) {
        const double vs = r.number(), ve = r.number(), j = r.number(), arc_length = r.number();
        const SCurve profile = plan_scurve(arc_length, vs, ve, {none, none, none, j}).profile;
        near(profile.durations()[0], r.number(), 1e-8, 1e-9, r.name);
        near(profile.durations()[4], r.number(), 1e-8, 1e-9, r.name);
        near(profile.peak_speed(), r.number(), 1e-8, 1e-9, r.name);
    }
}

// A period of constant acceleration, divided into equal lengths: v² is linear in the length.
TEST(InterpolatorVectors, EqualLengthsOfAPeriod) {
    for (VectorRow& r : rows("equal_length.txt")) {
        const double v0 = r.number(), v1 = r.number(), period = r.number();
        const int parts = static_cast<int>(r.number());
        const double arc_length = r.number();
        const double acceleration = (v1 - v0) / period;
        const std::vector<double> speeds = r.numbers(parts + 1), times = r.numbers(parts + 1);
        near(CellMotion{arc_length, v0, acceleration, 0}.duration(), period, 1e-9, 1e-12, r.name);
        double time = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(parts); ++k) {
            near(time, times[k], 1e-9, 1e-12, r.name);
            const CellMotion part{arc_length / parts, speeds[k], acceleration, 0};
            double speed = 0;
            near(part.arc_length_at(part.duration(), speed), arc_length / parts, 1e-9, 1e-12, r.name);
            near(speed, speeds[k + 1], 1e-9, 1e-9, r.name);
            time += part.duration();
        }
        near(time, period, 1e-9, 1e-12, r.name);
    }
}

TEST(LookaheadVectors, JerkLimitedScan) {
    for (VectorRow& r : rows("lookahead.txt")) {
        const double a = r.number(), j = r.number(), v0 = r.number(), end = r.number();
        const int n = static_cast<int>(r.number());
        const std::vector<double> lengths = r.numbers(n), limits = r.numbers(n - 1), feeds = r.numbers(n);
        std::vector<ScanSegment> sections;
        std::vector<double> speeds{v0};
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            sections.push_back({lengths[i], a, j});
            speeds.push_back(i + 1 < lengths.size() ? std::min({limits[i], feeds[i], feeds[i + 1]}) : end);
        }
        const bool braked = scan_speeds(sections, speeds);
        EXPECT_EQ(braked, r.word() == "ok") << r.name;
        const double expected_time = r.number();
        if (!braked) continue;
        double time = 0;
        for (std::size_t i = 0; i < lengths.size(); ++i)
            time += plan_scurve(lengths[i], speeds[i], speeds[i + 1], {feeds[i], a, a, j}).profile.duration();
        near(time, expected_time, 1e-7, 1e-9, r.name);
        for (const double v : speeds) near(v, r.number(), 1e-7, 1e-9, r.name);
    }
}

}  // namespace
}  // namespace clsurf::vectors_test
