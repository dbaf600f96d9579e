// Splines through points compared with scipy (point_spline_reference.py).

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "numeric/point_spline.h"

namespace clsurf::point_spline_test {
namespace {

using Case = std::map<std::string, std::vector<Vec3>>;

std::vector<Case> read_cases() {
    std::ifstream file(std::string(TEST_SOURCES) + "/numeric/vectors/point_spline.txt");
    std::vector<Case> cases;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        if (name == "case") cases.emplace_back();
        if (name.empty() || name == "#" || name == "case") continue;
        for (double x = 0, y = 0, z = 0; words >> x >> y >> z;) cases.back()[name].emplace_back(x, y, z);
    }
    return cases;
}

void expect_middles(const std::vector<BezierCurve>& spans, const std::vector<Vec3>& expected) {
    ASSERT_EQ(spans.size(), expected.size());
    for (std::size_t i = 0; i < spans.size(); ++i)
        EXPECT_LE((spans[i].at(0.5) - expected[i]).norm(), 1e-9) << "span " << i;
}

TEST(PointSpline, AgreesWithScipyAtEveryKindOfEnd) {
    const std::vector<Case> cases = read_cases();
    ASSERT_EQ(cases.size(), 3U);
    using Kind = PointSplineEnd::Kind;
    for (const Case& one : cases) {
        const std::vector<Vec3>& points = one.at("points");
        const PointSplineEnd natural{Kind::natural, Vec3::Zero()};
        expect_middles(cubic_spline(points, natural, natural), one.at("natural"));
        expect_middles(cubic_spline(points, {Kind::tangent, one.at("begin")[0]}, {Kind::tangent, one.at("end")[0]}),
                       one.at("tangent"));
        expect_middles(cubic_spline(points, {}, {}), one.at("free"));
        expect_middles(akima_spline(points, {}, {}), one.at("akima"));
    }
}

TEST(PointSpline, EndsHoldWhatTheyAreAsked) {
    const std::vector<Vec3> points{{0, 0, 0}, {3, 1, 0}, {4, 4, 1}, {9, 5, -2}};
    for (const auto& spline : {cubic_spline, akima_spline}) {
        const std::vector<BezierCurve> natural =
            spline(points, {PointSplineEnd::Kind::natural, {}}, {PointSplineEnd::Kind::natural, {}});
        EXPECT_LE(natural.front().jet(0).second.norm(), 1e-9);
        EXPECT_LE(natural.back().jet(1).second.norm(), 1e-9);
        const Vec3 out = Vec3(0, 1, 0);
        const std::vector<BezierCurve> along = spline(points, {PointSplineEnd::Kind::tangent, out}, {});
        EXPECT_LE((along.front().tangent(0) - out).norm(), 1e-12);
        // The slope is the same on both sides of a point.
        for (std::size_t i = 1; i < along.size(); ++i)
            EXPECT_LE((along[i].tangent(0) - along[i - 1].tangent(1)).norm(), 1e-12);
    }
}

TEST(PointSpline, TwoPointsAreALine) {
    const std::vector<Vec3> points{{1, 2, 3}, {4, 6, 3}};
    for (const auto& spline : {cubic_spline, akima_spline}) {
        const std::vector<BezierCurve> line = spline(points, {}, {});
        ASSERT_EQ(line.size(), 1U);
        EXPECT_NEAR(line[0].length(), 5, 1e-12);
        EXPECT_LE((line[0].at(0.5) - Vec3(2.5, 4, 3)).norm(), 1e-12);
    }
}

TEST(PointSpline, AFreeEndOfTwoSpansLeavesOneCubic) {
    const PointSplineEnd natural{PointSplineEnd::Kind::natural, {}};
    const std::vector<Vec3> bent{{0, 0, 0}, {3, 4, 0}, {3, 4, 5}};
    // Over u = 0, 5, 10: z = a u³ + b u with z(5) = 0, z(10) = 5.
    const double a = 5.0 / 750, b = -25 * a;
    const std::vector<BezierCurve> spans = cubic_spline(bent, natural, {});
    EXPECT_NEAR(spans[0].at(0.5).z(), a * 2.5 * 2.5 * 2.5 + b * 2.5, 1e-12);
    EXPECT_NEAR(spans[1].at(0.5).z(), a * 7.5 * 7.5 * 7.5 + b * 7.5, 1e-12);
    // In reverse order the result is the same.
    const std::vector<Vec3> back(bent.rbegin(), bent.rend());
    EXPECT_NEAR(cubic_spline(back, {}, natural)[1].at(0.5).z(), spans[0].at(0.5).z(), 1e-12);
}

}  // namespace
}  // namespace clsurf::point_spline_test
