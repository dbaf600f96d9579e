// The limits of the path for judging a simulated run.

#include "simulation/run/path_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"

namespace clsurf::path_limits_test {
namespace {

constexpr double period = 0.001;

double normal_of(const std::vector<Vec3>& positions, const std::vector<double>& speeds) {
    NormalAcceleration normal(period);
    for (std::size_t i = 1; i < positions.size(); ++i) normal.add(positions[i] - positions[i - 1], speeds[i]);
    normal.add(Vec3::Zero(), 0);
    return normal.greatest();
}

// 10 mm/s on a circle of 1 mm: v²/r = 100, minus some thousandths because of differences.
TEST(PathLimits, NormalAccelerationOfACircle) {
    std::vector<Vec3> positions;
    std::vector<double> speeds;
    for (int i = 0; i < 50; ++i) {
        positions.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i), 3);
        speeds.push_back(10);
    }
    EXPECT_NEAR(normal_of(positions, speeds), 100, 0.01);
}

// To rest in a corner of 170° and away again at 1000 mm/s²: all of it is along the path. Differences also have a normal part.
TEST(PathLimits, BrakingIntoACornerIsNotNormal) {
    std::vector<Vec3> positions;
    std::vector<double> speeds;
    const double turn = 170 * rad_per_deg;
    double naive = 0;
    for (int i = -10; i <= 10; ++i) {
        const double t = (i - 0.3) * period;
        const double way = 500 * t * t;
        positions.push_back(t < 0 ? Vec3(-way, 0, 0) : Vec3(way * std::cos(turn), way * std::sin(turn), 0));
        speeds.push_back(1000 * std::abs(t));
    }
    for (std::size_t i = 2; i < positions.size(); ++i) {
        const Vec3 in = positions[i - 1] - positions[i - 2], out = positions[i] - positions[i - 1];
        naive = std::max(naive, (out - in).cross(in + out).norm() / (in + out).norm() / (period * period));
    }
    EXPECT_GT(naive, 100);
    EXPECT_LT(normal_of(positions, speeds), 1);
}

// Two lines at right angles, each from rest to rest within a period: 4 · 0.001 mm / T² = 4000 mm/s² along them, none across.
TEST(PathLimits, LinesWithinAPeriodHaveNoNormalAcceleration) {
    EXPECT_EQ(normal_of({{0, 0, 0}, {0.001, 0, 0}, {0.001, 0.001, 0}}, {0, 0, 0}), 0);
}

TEST(PathLimits, TheWorstIsNamedAndWhatAPlannerDoesNotHoldIsNot) {
    Machine machine;
    SimulationSummary run;
    run.max_normal_acceleration = 1.0005 * machine.path.max_normal_acceleration;
    EXPECT_TRUE(excess_of_path(run, machine).what.empty());
    run.max_normal_acceleration = 1.02 * machine.path.max_normal_acceleration;
    run.max_tangential_acceleration = 1.01 * machine.path.max_acceleration;
    EXPECT_EQ(excess_of_path(run, machine).what, "normal acceleration of the path");
    EXPECT_NEAR(excess_of_path(run, machine).factor, 1.02, 1e-12);
    machine.controller.corner = CornerMode::junction;
    EXPECT_EQ(excess_of_path(run, machine).what, "tangential acceleration of the path");
    machine.controller.planner = PlannerKind::trapezoidal;
    machine.controller.corner = CornerMode::spline;
    EXPECT_EQ(excess_of_path(run, machine).what, "tangential acceleration of the path");
}

}  // namespace
}  // namespace clsurf::path_limits_test
