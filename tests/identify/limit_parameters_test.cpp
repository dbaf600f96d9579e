// A limit counts as reached if no other one explains it: machines with known limits, and their own runs.

#include "identify/limit_parameters.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "identify/plateaus.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"

namespace clsurf::limit_parameters_test {
namespace {

/// Lines from rest to rest in some directions, of several lengths and feeds.
std::string lines_along(const std::vector<Vec3>& directions) {
    std::string text = "G21 G90 G61\nG1 X0 Y0 Z0 F1000\n";
    for (const double feed : {1500.0, 3000.0, 6000.0}) {
        for (const Vec3& direction : directions) {
            for (const double length : {2.0, 5.0, 12.0}) {
                const Vec3 end = length * direction.normalized();
                text += fmt::format("G1 X{:.6f} Y{:.6f} Z{:.6f} F{}\nX0 Y0 Z0\n", end.x(), end.y(), end.z(), feed);
            }
        }
    }
    return text + "M2\n";
}

const std::vector<Vec3> parallel{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Vec3> all_ways{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {2, -1, 1}};

Machine with_jerks(double axes, double path) {
    Machine machine;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = axes, axis.max_acceleration = 6000;
    machine.path.max_jerk = path;
    machine.path.max_acceleration = 6000;
    return machine;
}

Identification identified(const Machine& machine, const std::vector<Vec3>& directions) {
    const Part part = assemble(read_text(lines_along(directions)),
                               simulate_to_log(read_text(lines_along(directions)), machine, Vec3::Zero()).log);
    const IdentifyRun run{&part.log, nullptr, nullptr};
    Identification result;
    identify_limits({&run, 1}, result);
    return result;
}

/// A jerk limit that is reported as reached is right, and a lower bound is at most the true value.
void expect_no_contradiction(const Identification& result, const char* of, double truth) {
    const IdentifiedParameter* jerk = result.find("max_jerk", of);
    ASSERT_NE(jerk, nullptr) << of;
    if (jerk->reached == true)
        EXPECT_NEAR(jerk->value, truth, 0.01 * truth) << of;
    else
        EXPECT_LE(jerk->value, truth) << of;
}

TEST(LimitParameters, ALimitOfThePathIsNoneOfTheAxes) {
    const Identification result = identified(with_jerks(80000, 50000), all_ways);
    for (const char* axis : {"x", "y", "z"}) {
        expect_no_contradiction(result, axis, 80000);
        EXPECT_EQ(result.find("max_jerk", axis)->reached, false) << axis;
        EXPECT_GT(result.find("max_jerk", axis)->value, 49000) << axis;
    }
    EXPECT_EQ(result.find("max_jerk", "path")->reached, true);
    expect_no_contradiction(result, "path", 50000);
    EXPECT_EQ(result.machine.axes[0].max_jerk, 80000);  // what was known before
}

TEST(LimitParameters, ALimitOfAnAxisIsReachedWhereThePathGoesBeyondIt) {
    const Identification result = identified(with_jerks(50000, 400000), all_ways);
    for (const char* axis : {"x", "y", "z"}) {
        EXPECT_EQ(result.find("max_jerk", axis)->reached, true) << axis;
        expect_no_contradiction(result, axis, 50000);
    }
    EXPECT_EQ(result.find("max_jerk", "path")->reached, false);
    expect_no_contradiction(result, "path", 400000);
}

TEST(LimitParameters, LinesAlongTheAxesTellNoneFromThePath) {
    const Identification of_path = identified(with_jerks(80000, 50000), parallel);
    const Identification of_axes = identified(with_jerks(50000, 400000), parallel);
    for (const Identification* result : {&of_path, &of_axes}) {
        for (const char* of : {"x", "y", "z", "path"}) {
            EXPECT_EQ(result->find("max_jerk", of)->reached, false) << of;
            expect_no_contradiction(*result, of, 50000);
        }
        EXPECT_NEAR(result->machine.path.max_jerk, 50000, 500) << "a file that repeats the runs";
    }
}

/// The same limits in runs of 1 and 2 ms, of which the second alone goes along oblique lines.
TEST(LimitParameters, RunsOfSeveralPeriodsShowOneLimit) {
    Machine machine = with_jerks(80000, 50000);
    std::vector<Part> parts;
    for (const auto& [period, directions] : {std::pair(0.001, parallel), std::pair(0.002, all_ways)}) {
        machine.controller.period = period;
        const std::string text = lines_along(directions);
        parts.push_back(assemble(read_text(text), simulate_to_log(read_text(text), machine, Vec3::Zero()).log));
    }
    const std::array runs{IdentifyRun{&parts[0].log, nullptr, nullptr}, IdentifyRun{&parts[1].log, nullptr, nullptr}};
    Identification result, first, second;
    identify_limits(runs, result);
    identify_limits({&runs[0], 1}, first);
    identify_limits({&runs[1], 1}, second);
    EXPECT_EQ(result.find("max_jerk", "path")->reached, true);
    for (const char* of : {"x", "y", "z"}) expect_no_contradiction(result, of, 80000);
    expect_no_contradiction(result, "path", 50000);
    const auto acceleration = [](const Identification& of) { return of.find("max_acceleration", "path")->value; };
    const double greater = std::max(acceleration(first), acceleration(second));
    EXPECT_NEAR(acceleration(result), greater, 0.01 * greater);
}

/// Values of a quantity with some plateaus of 8 records each, at increasing speeds, with ramps between them.
PlateauFinder with_plateaus(const std::vector<double>& levels) {
    std::vector<double> values, speeds;
    double speed = 10;
    for (const double level : levels) {
        for (int i = 0; i < 40; ++i) values.push_back(level * i / 40);
        values.insert(values.end(), 8, level);
        for (int i = 39; i > 0; --i) values.push_back(level * i / 40);
        speed += 5;
        speeds.resize(values.size(), speed);
    }
    PlateauFinder finder(1e-9, 5, *std::max_element(levels.begin(), levels.end()), true);
    const std::vector<std::vector<double>> all{values};
    finder.add(all, 0, speeds, {});
    return finder;
}

TEST(LimitParameters, ALevelBeyondWhichTheMotionStaysElsewhereIsNoLimit) {
    std::vector<double> levels(60, 100);
    ASSERT_TRUE(with_plateaus(levels).highest(3, true));
    EXPECT_NEAR(with_plateaus(levels).highest(3, true)->value, 100, 1e-6);
    // 16 of some 2900 large values: hardly any.
    levels[20] = levels[40] = 115;
    EXPECT_FALSE(with_plateaus(levels).highest(3, true));
    EXPECT_NEAR(with_plateaus(levels).held(), 115, 1e-6);
}

}  // namespace
}  // namespace clsurf::limit_parameters_test
