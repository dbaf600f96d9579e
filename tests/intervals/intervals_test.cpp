// Constant-speed intervals compared with independently computed vectors, and edge cases.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "intervals/intervals.h"

namespace clsurf::intervals_test {
namespace {

struct Case {
    std::string name;
    std::vector<double> input, kappa, features, boundaries;
    std::vector<Vec3> points;
    std::vector<std::vector<double>> intervals;
};

std::vector<Case> read_cases() {
    std::ifstream file(std::string(TEST_SOURCES) + "/intervals/vectors/constant_speed_intervals.txt");
    std::vector<Case> cases;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "case") {
            cases.emplace_back();
            words >> cases.back().name;
            continue;
        }
        std::vector<double> numbers;
        for (double value = 0; words >> value;) numbers.push_back(value);
        Case& c = cases.back();
        if (kind == "input") c.input = numbers;
        if (kind == "kappa") c.kappa = numbers;
        if (kind == "features") c.features = numbers;
        if (kind == "boundaries") c.boundaries = numbers;
        if (kind == "interval") c.intervals.push_back(numbers);
        if (kind != "points") continue;
        for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
            c.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
    return cases;
}

std::vector<double> as_numbers(const std::vector<std::size_t>& indices) { return {indices.begin(), indices.end()}; }

TEST(IntervalVectors, CurvatureCornersBoundariesAndSpeeds) {
    const std::vector<Case> cases = read_cases();
    ASSERT_EQ(cases.size(), 4U);
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        IntervalRules rules;
        rules.error = c.input[0];
        rules.length_ratio = c.input[1];
        rules.curvature_ratio = c.input[2];
        rules.flat_curvature = c.input[3];
        rules.drift_ratio = 0;
        const SpeedLimits limits{c.input[5], 0, c.input[6], c.input[7]};
        const std::vector<double> kappa = curvatures(c.points);
        ASSERT_EQ(kappa.size(), c.kappa.size());
        for (std::size_t i = 0; i < kappa.size(); ++i) EXPECT_NEAR(kappa[i], c.kappa[i], 1e-6);
        EXPECT_EQ(as_numbers(characteristic_points(c.points, rules.error)), c.features);
        EXPECT_EQ(as_numbers(interval_boundaries(c.points, kappa, rules)), c.boundaries);
        const std::vector<SpeedInterval> intervals = divide(c.points, rules);
        ASSERT_EQ(intervals.size(), c.intervals.size());
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            EXPECT_EQ(static_cast<double>(intervals[i].first), c.intervals[i][0]);
            EXPECT_EQ(static_cast<double>(intervals[i].last), c.intervals[i][1]);
            EXPECT_NEAR(intervals[i].mean_curvature, c.intervals[i][2], 1e-6);
            EXPECT_NEAR(intervals[i].greatest_curvature, c.intervals[i][3], 1e-6);
            EXPECT_NEAR(planned_speed(intervals[i], c.input[4], limits), c.intervals[i][4], 1e-4);
        }
    }
}

TEST(IntervalVectors, AreTheSameForthAndBack) {
    for (Case& c : read_cases()) {
        SCOPED_TRACE(c.name);
        IntervalRules rules;
        rules.error = c.input[0];
        rules.drift_ratio = 0;
        std::vector<SpeedInterval> forth = divide(c.points, rules);
        std::reverse(c.points.begin(), c.points.end());
        std::vector<SpeedInterval> back = divide(c.points, rules);
        ASSERT_EQ(forth.size(), back.size());
        for (std::size_t i = 0; i < forth.size(); ++i)
            EXPECT_EQ(c.points.size() - 1 - back[back.size() - 1 - i].last, forth[i].first);
    }
}

// A clothoid: the curvature changes little from point to point, but much over the whole.
TEST(Intervals, CutWhereCurvatureDrifts) {
    std::vector<Vec3> points{Vec3::Zero()};
    double angle = 0, curvature = 0.002;
    for (int i = 0; i < 40; ++i, curvature *= 1.1) {
        points.push_back(points.back() + 0.5 * Vec3(std::cos(angle), std::sin(angle), 0));
        angle += 0.5 * curvature;
    }
    IntervalRules rules;
    rules.drift_ratio = 0;
    EXPECT_EQ(divide(points, rules).size(), 1U);
    rules.drift_ratio = 2;
    const std::vector<SpeedInterval> cut = divide(points, rules);
    EXPECT_GE(cut.size(), 4U);
    for (const SpeedInterval& interval : cut)
        EXPECT_LE(interval.greatest_curvature, 2.01 * std::max(interval.mean_curvature, rules.flat_curvature));
}

// A line, an arc of 1.2 rad and a line, by arc length, with coordinates rounded to micrometres.
TEST(Intervals, EndWithinABlockOfWhereALineMeetsAnArc) {
    constexpr double line = 20, turn = 1.2;
    IntervalRules rules;
    rules.coordinate_step = 0.001;
    for (const double radius : {3.0, 10.0, 50.0}) {
        for (const double block : {0.05, 0.1, 0.5}) {
            for (const double first : {0.0, 0.33, 0.7}) {
                std::vector<Vec3> points;
                std::vector<double> way;
                for (double s = first * block; s < 2 * line + radius * turn; s += block) {
                    const double angle = std::clamp((s - line) / radius, 0.0, turn);
                    const double rest = s < line ? s - line : std::max(0.0, s - line - radius * turn);
                    const Vec3 at(radius * std::sin(angle) + rest * std::cos(angle), 0,
                                  radius * (1 - std::cos(angle)) + rest * std::sin(angle));
                    points.push_back((at / rules.coordinate_step).array().round() * rules.coordinate_step);
                    way.push_back(s);
                }
                const std::vector<SpeedInterval> intervals = divide(points, rules);
                EXPECT_LE(intervals.size(), 4U) << radius << " " << block;
                for (const double meets : {line, line + radius * turn}) {
                    double off = line;
                    for (const SpeedInterval& interval : intervals)
                        off = std::min(off, std::abs(way[interval.first] - meets));
                    EXPECT_LE(off, std::max(block, 0.06)) << radius << " " << block << " " << first << " " << meets;
                }
            }
        }
    }
}

TEST(Intervals, OfWhatHasNoInside) {
    EXPECT_TRUE(divide({}, {}).empty());
    EXPECT_TRUE(divide(std::vector<Vec3>{{1, 1, 1}}, {}).empty());
    const std::vector<SpeedInterval> line = divide(std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}}, {});
    ASSERT_EQ(line.size(), 1U);
    EXPECT_EQ(line[0].greatest_curvature, 0);
    EXPECT_EQ(planned_speed(line[0], 50, {}), 50);
    const std::vector<SpeedInterval> straight =
        divide(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {});
    ASSERT_EQ(straight.size(), 1U);
    EXPECT_EQ(straight[0].greatest_curvature, 0);
}

TEST(Intervals, EndWhereThePathTurnsBack) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    const std::vector<SpeedInterval> intervals = divide(points, {});
    ASSERT_EQ(intervals.size(), 2U);
    EXPECT_EQ(intervals[0].last, 3U);
}

// A closed loop has no natural ends: it is cut at the point farthest from its start.
TEST(Intervals, CharacteristicPointsOfALoopAreThoseOfItsHalves) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 64; ++i)
        points.emplace_back(std::cos(std::numbers::pi * i / 32), std::sin(std::numbers::pi * i / 32), 0);
    points.back() = points.front();
    const std::vector<std::size_t> corners = characteristic_points(points, 0.01);
    EXPECT_TRUE(std::find(corners.begin(), corners.end(), 32U) != corners.end());
    EXPECT_GT(corners.size(), 8U);
    EXPECT_LT(corners.size(), 40U);
}

}  // namespace
}  // namespace clsurf::intervals_test
