// The speed derived from positions compared with the speed that the kernel recorded. The kernel's channel
// belongs to its planner and leads the axes by two records in every log (data/logs/README.md).
#include <array>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "core/units.h"
#include "io/formats/log_format.h"
#include "numeric/derivative.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf::recorded_speed_test {
namespace {

constexpr PointIndex lead = 2;  // [records]
constexpr std::array logs{"bottle_uneven",    "bottle_zigzag",          "dome_loops",     "transition_g61",
                          "petal_zigzag_g64", "petal_zigzag_irregular", "petal_loops_g64"};

struct Speeds {
    std::vector<double> derived, recorded;  // [mm/min]
    std::vector<double> motion;             // 0: none

    Speeds(const char* name, const DerivativeFilter& filter) {
        const Log log = io::open_log(std::string(SAMPLE_LOGS "/") + name + ".biip", {});
        const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
        const auto n = static_cast<std::size_t>(log.records);
        std::array<std::vector<double>, 3> position;
        for (std::vector<double>& column : position) column.resize(n);
        path.read(0, position[0], position[1], position[2]);
        const Differentiator d(filter);
        derived.assign(n, 0.0);
        std::vector<double> along(n);
        for (const std::vector<double>& column : position) {
            d.apply(column, 0, {0, log.records - 1}, 0, along);
            for (std::size_t i = 0; i < n; ++i) derived[i] = std::hypot(derived[i], along[i] * seconds_per_minute);
        }
        recorded.resize(n);
        motion.resize(n);
        copy_block(log.find("speed")->values, 0, recorded);
        copy_block(log.find("motion")->values, 0, motion);
    }
    /// Difference [mm/min, rms] if the recorded speed leads by `shift` records.
    [[nodiscard]] double rms(PointIndex shift) const {
        double sum = 0;
        double count = 0;
        constexpr std::size_t margin = 30;
        for (std::size_t i = margin; i + margin < derived.size(); ++i) {
            if (motion[i] == 0) continue;
            const double off = recorded[i] - derived[static_cast<std::size_t>(static_cast<PointIndex>(i) + shift)];
            sum += off * off;
            ++count;
        }
        return std::sqrt(sum / count);
    }
};

class RecordedSpeed : public testing::TestWithParam<const char*> {};

TEST_P(RecordedSpeed, IsThatOfThreePointsTwoRecordsLater) {
    // Differences over two records, 2 ms: almost no smoothing, and no noise in commanded positions.
    const Speeds speeds(GetParam(), {3, 2, 1, 0.001});
    EXPECT_LT(speeds.rms(lead), 15.0);  // of 9,000 … 15,000 mm/min
    for (const PointIndex other : {-1, 0, 1, 3, 4}) EXPECT_GT(speeds.rms(other), 5 * speeds.rms(lead)) << other;
}

TEST_P(RecordedSpeed, IsThatOfOurWindowButForItsSmoothing) {
    // 20 ms smooth the speed at corners: exact stops are the worst case.
    const Speeds speeds(GetParam(), derivative_filter(1, 0.001));
    EXPECT_LT(speeds.rms(lead), 180.0);
    for (const PointIndex other : {-1, 0, 1, 3, 4}) EXPECT_GT(speeds.rms(other), speeds.rms(lead)) << other;
}

// The Kalman smoother on every log and role: its speeds are compared with differences over two records of positions without
// noise and, for commanded ones, with the kernel's own speed two records earlier. The table is printed.
TEST_P(RecordedSpeed, OfAKalmanSmootherHoldsItsUncertainty) {
    const Log log = io::open_log(std::string(SAMPLE_LOGS "/") + GetParam() + ".biip", {});
    const std::vector<PointRange> all{{0, log.records - 1}};
    const auto n = static_cast<std::size_t>(log.records);
    std::vector<double> channel(n);
    copy_block(log.find("speed")->values, 0, channel);
    for (const Role role : {Role::commanded, Role::feedback}) {
        const Trajectory path = reconstruct(log, role, Vec3::Zero());
        const MotionEstimate estimate(log, path, all);
        EXPECT_EQ(estimate.speed_lead(), role == Role::commanded ? lead : 0);
        MotionEstimate::Scratch scratch;
        std::array<std::array<std::vector<double>, 3>, 4> smoothed;
        estimate.estimate(all[0], 0, log.records - 1, scratch, smoothed);
        std::vector<double> sigma(n);
        estimate.sigmas(1, all[0], 0, scratch, sigma);
        const Differentiator window(derivative_filter(1, log.period));
        std::array<std::vector<double>, 3> p, v;
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis].resize(n), v[axis].resize(n);
        path.read(0, p[0], p[1], p[2]);
        for (std::size_t axis = 0; axis < 3; ++axis) window.apply(p[axis], 0, all[0], 0, v[axis]);
        double of_window = 0, of_smoother = 0, within = 0, within_channel = 0, count = 0;
        for (std::size_t i = 30; i + 30 < n; ++i, ++count) {
            const auto norm = [i](const std::array<std::vector<double>, 3>& x) {
                return std::hypot(x[0][i], x[1][i], x[2][i]) * seconds_per_minute;
            };
            double difference = 0;
            for (const std::vector<double>& x : p) difference = std::hypot(difference, x[i + 1] - x[i - 1]);
            difference *= seconds_per_minute / (2 * log.period);
            const double reach = 3 * sigma[i] * seconds_per_minute;
            const double off = norm(smoothed[1]) - difference;
            of_window += std::pow(norm(v) - difference, 2);
            of_smoother += off * off;
            within += std::abs(off) <= reach ? 1 : 0;
            within_channel += std::abs(norm(smoothed[1]) - channel[i - lead]) <= reach ? 1 : 0;
        }
        std::printf(
            "%-24s %-9s rms of the window %7.2f, of the smoother %5.2f mm/min; within three deviations %.2f %%\n",
            GetParam(), role == Role::commanded ? "commanded" : "feedback", std::sqrt(of_window / count),
            std::sqrt(of_smoother / count), 100 * within / count);
        EXPECT_LT(of_smoother, 0.02 * of_window);
        EXPECT_GE(within / count, 0.99);
        if (role == Role::commanded) { EXPECT_GE(within_channel / count, 0.99); }
    }
}

INSTANTIATE_TEST_SUITE_P(Recorded, RecordedSpeed, testing::ValuesIn(logs));

}  // namespace
}  // namespace clsurf::recorded_speed_test
