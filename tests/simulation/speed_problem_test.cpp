// SpeedProblem compared with optima of linear programs (vectors/speed_optimum.py): the times are equal, and no limit is
// exceeded.
#include "simulation/plan/speed_problem.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/vector_rows.h"

namespace clsurf::speed_problem_test {
namespace {

constexpr double length = 12;  // [mm]
constexpr int cells = 240;
constexpr double cell_length = length / cells;

/// The path of the script: curvature k sin²(2πu/length) in the plane of X and Y.
PathSample path_at(double u, double k) {
    const double wave = 2 * std::numbers::pi / length;
    const double kappa = k * std::pow(std::sin(wave * u), 2);
    const double turn = k * wave * std::sin(2 * wave * u);
    const double angle = k * (u / 2 - std::sin(2 * wave * u) / (4 * wave));
    const Vec3 t(std::cos(angle), std::sin(angle), 0);
    const Vec3 n(-std::sin(angle), std::cos(angle), 0);
    return {0, t, kappa * n, turn * n - kappa * kappa * t};
}

struct Case {
    std::string name;
    double k, cap, slow_cap, path_acceleration, path_jerk, axis_acceleration, axis_jerk, speed;
    double coarse, fine;  // times [s]
    [[nodiscard]] double cap_at(double u) const { return std::abs(u - length / 2) < length / 12 ? slow_cap : cap; }
};

std::vector<Case> read_cases() {
    std::vector<Case> all;
    for (VectorRow& row : vector_rows("simulation", "speed_optimum.txt")) {
        const std::vector<double> v = row.numbers(8);
        (void)row.word();
        const std::vector<double> times = row.numbers(2);
        all.push_back({row.name, v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], times[0], times[1]});
    }
    return all;
}

/// v² and its derivatives along the path: the quadratic B-spline of uniform cells through their coefficients.
struct Square {
    double b, slope, curve;
};
Square square_at(const std::vector<double>& c, int cell, double t) {
    const double before = c[static_cast<std::size_t>(cell)], here = c[static_cast<std::size_t>(cell) + 1],
                 after = c[static_cast<std::size_t>(cell) + 2];
    return {0.5 * (1 - t) * (1 - t) * before + (0.5 + t * (1 - t)) * here + 0.5 * t * t * after,
            ((1 - t) * (here - before) + t * (after - here)) / cell_length,
            (before - 2 * here + after) / (cell_length * cell_length)};
}

/// The largest used share of a limit, and the time.
struct Outcome {
    double most = 0, time = 0;
};
Outcome measure(const Case& of, const std::vector<double>& c) {
    Outcome out;
    constexpr int samples = 20;
    for (int cell = 0; cell < cells; ++cell) {
        for (int s = 0; s < samples; ++s) {
            const double t = (s + 0.5) / samples;
            const double u = (cell + t) * cell_length;
            const auto [b, slope, curve] = square_at(c, cell, t);
            out.time += cell_length / samples / std::sqrt(b);
            const PathSample at = path_at(u, of.k);
            const auto use = [&](double value, double limit) {
                out.most = std::max(out.most, std::abs(value) / limit);
            };
            use(std::sqrt(b), of.cap_at(u));
            use(0.5 * slope, of.path_acceleration);
            use(0.5 * std::sqrt(b) * curve, of.path_jerk);
            for (int x = 0; x < 2; ++x) {
                use(0.5 * at.first[x] * slope + at.second[x] * b, of.axis_acceleration);
                if (of.axis_jerk <= 0) continue;
                use(std::sqrt(b) * (0.5 * at.first[x] * curve + 1.5 * at.second[x] * slope + at.third[x] * b),
                    of.axis_jerk);
            }
        }
    }
    return out;
}

TEST(SpeedProblem, TakesTheTimeOfTheOptimum) {
    const std::vector<Case> cases = read_cases();
    ASSERT_EQ(cases.size(), 6U);
    for (const Case& of : cases) {
        SCOPED_TRACE(of.name);
        Machine machine;
        for (MachineAxis& axis : machine.axes) {
            axis.max_acceleration = of.axis_acceleration;
            axis.max_jerk = of.axis_jerk;
        }
        SpeedProblem problem(linear_limits(machine));
        problem.clear();
        for (int i = 0; i < cells; ++i) {
            const double begin = i * cell_length;
            problem.add_cell(cell_length, of.speed * of.speed,
                             {of.cap_at(begin + 0.5 * cell_length), of.path_acceleration, of.path_jerk});
            for (const double part : {0.0, 0.5, 1.0}) {
                PathSample at = path_at(begin + part * cell_length, of.k);
                at.at = part * cell_length;
                problem.add_sample(at);
            }
        }
        ASSERT_TRUE(problem.solve({of.speed, 0}, {of.speed, 0}));
        std::vector<double> c{of.speed * of.speed};  // beyond the ends: no acceleration there
        for (std::size_t i = 0; i < cells; ++i) c.push_back(problem.value(i));
        c.push_back(of.speed * of.speed);
        const Outcome out = measure(of, c);
        EXPECT_LE(out.most, 1.005);
        // The grid of the linear program is slightly coarse: the tolerance is twice the change by halving it.
        const double doubt = 2 * std::abs(of.fine - of.coarse) / of.fine;
        EXPECT_GE(out.time, of.fine * (1 - doubt - 0.001));
        EXPECT_LE(out.time, of.fine * (1 + doubt + 0.006));
        RecordProperty(of.name, std::to_string(out.time / of.fine));
    }
}

TEST(SpeedProblem, EntersACellWithTheAccelerationThatTheCellAllows) {
    // Speed falls through cells that allow a large acceleration, then through cells that allow a small one.
    Machine machine;
    SpeedProblem problem(linear_limits(machine));
    problem.clear();
    constexpr int half = 20;
    constexpr double h = 0.05, much = 4000, little = 250;
    for (int i = 0; i < 2 * half; ++i)
        problem.add_cell(h, 100, {i < half ? 60.0 : 10.0, i < half ? much : little, 1e6});
    ASSERT_TRUE(problem.solve({10, 0}, {10, 0}));
    // The acceleration is half the slope of v², which is linear in each cell: its ends are its extremes.
    for (std::size_t i = 0; i + 1 < 2 * half; ++i) {
        const double acceleration = 0.5 * (problem.value(i + 1) - problem.value(i)) / h;
        EXPECT_LE(std::abs(acceleration), (i + 1 < half ? much : little) * 1.0003) << i;
    }
}

TEST(SpeedProblem, KeepsItsValuesWhereNothingIsFaster) {
    Machine machine;
    SpeedProblem problem(linear_limits(machine));
    problem.clear();
    for (int i = 0; i < 8; ++i) problem.add_cell(1, 400, {20, 1000, 1e5});  // already at its cap
    EXPECT_FALSE(problem.solve({20, 0}, {20, 0}));
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(problem.value(i), 400);
    problem.clear();
    for (int i = 0; i < 3; ++i) problem.add_cell(1, 400, {100, 1000, 1e5});
    EXPECT_FALSE(problem.solve({20, 0}, {20, 0})) << "fewer than four cells";
}

// b = u² + 100 over ten cells of 1 mm on a straight line: the coefficient of the cell from i is i (i + 1) + 100, and at the
// end the acceleration is 10 and the jerk √200. With a share s of v², the acceleration has the share s and the jerk s √s.
TEST(SpeedProblem, SaysBySlowingDownWhichShareEveryLimitHolds) {
    const auto share = [](double acceleration, double jerk, double cap) {
        ProblemLimits<5> limits;
        limits.acceleration.setConstant(acceleration);
        limits.jerk.setConstant(jerk);
        limits.path_acceleration = limits.path_jerk = 1e9;
        AxisSpeedProblem<5> problem(limits, FirstSpeeds::guess);
        AxisSample<5> straight;
        straight.first[0] = 1;
        problem.clear();
        for (int i = 0; i < 10; ++i) {
            problem.add_cell(1, i * (i + 1) + 100, {cap, 1e9, 1e9});
            for (const double at : {0.0, 1.0}) {
                straight.at = at;
                problem.add_sample(straight);
            }
        }
        return problem.holding_share({10, 0}, {std::sqrt(200.0), 10});
    };
    EXPECT_DOUBLE_EQ(share(20, 20, 20), 1);
    EXPECT_NEAR(share(5, 1e9, 1e9), 0.5, 1e-12);
    EXPECT_NEAR(share(1e9, 10, 1e9), std::pow(10 / std::sqrt(200.0), 2.0 / 3), 1e-12);
    EXPECT_NEAR(share(1e9, 1e9, 10), 0.5, 1e-12);
}

}  // namespace
}  // namespace clsurf::speed_problem_test
