// The curve compared with independently computed vectors, and properties of a spline through
// any points.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "numeric/akima.h"

namespace clsurf::akima_test {
namespace {

using Case = std::map<std::string, std::vector<double>>;

std::vector<Case> read_cases() {
    std::ifstream file(std::string(TEST_SOURCES) + "/numeric/vectors/akima.txt");
    std::vector<Case> cases;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream words(line);
        std::string name;
        words >> name;
        if (name == "case") {
            cases.emplace_back();
            continue;
        }
        for (double value = 0; words >> value;) cases.back()[name].push_back(value);
    }
    return cases;
}

std::vector<Vec3> points_of(const std::vector<double>& numbers) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

void expect_points(const std::vector<Vec3>& found, const std::vector<double>& expected) {
    const std::vector<Vec3> points = points_of(expected);
    ASSERT_EQ(found.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LE((found[i] - points[i]).norm(), 1e-8 + 1e-6 * points[i].norm()) << "point " << i;
}

std::vector<Vec3> middles(const std::vector<CubicSpan>& spans) {
    std::vector<Vec3> middles;
    for (const CubicSpan& span : spans) middles.push_back(span.at(0.5 * span.chord));
    return middles;
}

std::vector<Vec3> random_path(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> step(0.2, 2), aside(-1, 1);
    std::vector<Vec3> points{Vec3::Zero()};
    while (points.size() < count) points.push_back(points.back() + Vec3(step(random), aside(random), aside(random)));
    return points;
}

TEST(AkimaVectors, TangentsPointsAndLengths) {
    const std::vector<Case> cases = read_cases();
    ASSERT_EQ(cases.size(), 5U);
    for (const Case& c : cases) {
        const std::vector<Vec3> points = points_of(c.at("points"));
        const std::vector<CubicSpan> spans = akima_spans(points);
        std::vector<Vec3> tangents;
        for (const CubicSpan& span : spans) tangents.push_back(span.derivative(0));
        tangents.push_back(spans.back().derivative(spans.back().chord));
        expect_points(tangents, c.at("tangents"));
        expect_points(middles(spans), c.at("mid"));
        expect_points(middles(akima_spans(points, AkimaTangents::unit)), c.at("unit_mid"));
        const std::vector<CubicSpan> unit = akima_spans(points, AkimaTangents::unit);
        for (std::size_t i = 0; i < spans.size(); ++i) {
            EXPECT_NEAR(spans[i].arc_length_to(spans[i].chord), c.at("lengths")[i], 1e-6);
            EXPECT_NEAR(unit[i].arc_length_to(unit[i].chord), c.at("unit_lengths")[i], 1e-6);
        }
    }
}

TEST(Akima, OfTwoPointsIsTheirLine) {
    const std::vector<CubicSpan> spans = akima_spans(std::vector<Vec3>{{1, 2, 3}, {4, 6, 3}});
    ASSERT_EQ(spans.size(), 1U);
    EXPECT_LE((spans[0].at(2.5) - Vec3(2.5, 4, 3)).norm(), 1e-12);
    EXPECT_NEAR(spans[0].arc_length_to(5), 5, 1e-12);
    EXPECT_TRUE(akima_spans(std::vector<Vec3>{{1, 2, 3}}).empty());
    EXPECT_TRUE(akima_spans({}).empty());
}

TEST(Akima, MeetsItsPointsWithOneTangent) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::vector<Vec3> points = random_path(random, 3 + static_cast<std::size_t>(trial % 20));
        const std::vector<CubicSpan> spans =
            akima_spans(points, trial % 2 == 0 ? AkimaTangents::plain : AkimaTangents::unit);
        ASSERT_EQ(spans.size() + 1, points.size());
        for (std::size_t i = 0; i < spans.size(); ++i) {
            EXPECT_LE((spans[i].at(0) - points[i]).norm(), 1e-12);
            EXPECT_LE((spans[i].at(spans[i].chord) - points[i + 1]).norm(), 1e-9);
            if (i == 0) continue;
            EXPECT_LE((spans[i].derivative(0) - spans[i - 1].derivative(spans[i - 1].chord)).norm(), 1e-9);
        }
    }
}

TEST(Akima, IsTheSameForthAndBack) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<Vec3> points = random_path(random, 2 + static_cast<std::size_t>(trial % 12));
        const std::vector<CubicSpan> forth = akima_spans(points);
        std::reverse(points.begin(), points.end());
        const std::vector<CubicSpan> back = akima_spans(points);
        for (std::size_t i = 0; i < forth.size(); ++i) {
            const CubicSpan& other = back[back.size() - 1 - i];
            EXPECT_LE((forth[i].at(0.3 * forth[i].chord) - other.at(0.7 * other.chord)).norm(), 1e-9);
        }
    }
}

TEST(Akima, StreamGivesSpansTwoPointsBehind) {
    std::mt19937 random(3);
    const std::vector<Vec3> points = random_path(random, 9);
    const std::vector<CubicSpan> whole = akima_spans(points);
    std::vector<CubicSpan> given;
    AkimaStream stream([&](const CubicSpan& span) { given.push_back(span); });
    for (std::size_t i = 0; i < points.size(); ++i) {
        stream.add(points[i]);
        EXPECT_EQ(given.size(), i < 3 ? 0 : i - 2) << "after point " << i;
    }
    stream.finish();
    ASSERT_EQ(given.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(given[i].at(0.1), whole[i].at(0.1));
}

// The error on a circle decreases with the fourth power of the spacing (inside, where no slope is extrapolated).
TEST(Akima, ComesNearACircleWithTheFourthPower) {
    const auto error = [](int spans_of_quarter) {
        std::vector<Vec3> points;
        for (int i = 0; i <= 2 * spans_of_quarter; ++i) {
            const double angle = 0.5 * std::numbers::pi * i / spans_of_quarter;
            points.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), 0);
        }
        const std::vector<CubicSpan> spans = akima_spans(points);
        const CubicSpan& middle = spans[spans.size() / 2];
        return std::abs(middle.at(0.5 * middle.chord).norm() - 10);
    };
    EXPECT_NEAR(error(5) / error(10), 16, 1.5);
    EXPECT_LT(error(10), 0.0003);
}

TEST(Akima, AtArcLengthInvertsTheArcLength) {
    std::mt19937 random(4);
    for (const CubicSpan& span : akima_spans(random_path(random, 200))) {
        for (const double part : {0.0, 0.1, 0.5, 0.93, 1.0}) {
            const double arc_length = part * span.arc_length_to(span.chord);
            EXPECT_NEAR(span.arc_length_to(span.at_arc_length(arc_length)), arc_length, 1e-9);
        }
    }
}

}  // namespace
}  // namespace clsurf::akima_test
