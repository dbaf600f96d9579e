// Planted outliers are all found, and no others; features that resemble outliers are kept.

#include "scan/clean_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clsurf::clean_scan_test {
namespace {

std::vector<ScanPoint> wave(std::size_t count, double noise) {
    std::mt19937 random(3);
    std::normal_distribution<double> scatter(0, 1);
    std::vector<ScanPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 0.1 * static_cast<double>(i);
        points.push_back({x, 5 + 4 * std::sin(0.2 * x) + noise * scatter(random)});
    }
    return points;
}

TEST(CleanScan, PlantedOutliersAreFoundAlsoAtTheEndsAndInPairs) {
    std::vector<ScanPoint> points = wave(1500, 0.01);
    const std::vector<std::size_t> planted{0, 100, 101, 400, 777, 1200, 1499};
    for (const std::size_t i : planted) points[i].z += i % 2 == 0 ? 0.4 : -0.4;
    const CleanScan scan = clean_scan(points, 5);
    ASSERT_EQ(scan.rejected.size(), planted.size());
    for (std::size_t k = 0; k < planted.size(); ++k) EXPECT_EQ(scan.rejected[k].x, points[planted[k]].x);
    EXPECT_EQ(scan.x.size(), points.size() - planted.size());
    EXPECT_EQ(clean_scan(points, 0).x.size(), points.size()) << "0: none is rejected";
}

TEST(CleanScan, AMarkOfAMissingValueHidesNoOutlier) {
    for (const double mark : {999999.0, 1e20, -9.9e37, 3.4e38, 1e300, -1.7e308}) {
        std::vector<ScanPoint> points = wave(1000, 0.001);
        const std::vector<std::size_t> planted{100, 300, 500, 700, 900};
        for (const std::size_t i : planted) points[i].z += 0.4;
        points[200].z = mark;
        EXPECT_EQ(clean_scan(points, 5).rejected.size(), planted.size() + 1) << mark;
    }
}

/// SciPy's siegelslopes over nine points at a time rejects the same points of such a scan.
TEST(CleanScan, ThreePlacesInARowAreFoundAndTheirNeighboursKept) {
    std::vector<ScanPoint> points = wave(1000, 0.01);
    for (const std::size_t i : {300U, 500U, 501U, 502U}) points[i].z += 0.8;
    const CleanScan scan = clean_scan(points, 5);
    ASSERT_EQ(scan.rejected.size(), 4U);
    EXPECT_EQ(scan.rejected[0].x, points[300].x);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(scan.rejected[k].x, points[499 + k].x);
}

TEST(CleanScan, OutliersAreFoundWhereEachPlaceIsScannedTwice) {
    std::vector<ScanPoint> points;
    for (const ScanPoint& p : wave(1000, 0.01)) points.insert(points.end(), 2, p);
    points[1401].z += 0.8;                                       // one of the two
    for (std::size_t i = 600; i < 606; ++i) points[i].z += 0.8;  // both, three points each
    const CleanScan scan = clean_scan(points, 5);
    ASSERT_EQ(scan.rejected.size(), 7U);
    EXPECT_EQ(scan.rejected[6].z, points[1401].z);
    EXPECT_EQ(scan.x.size(), 997U) << "the other point of that place is kept";
}

TEST(CleanScan, OfNormalScatterHardlyAnyIsRejected) {
    const std::vector<ScanPoint> points = wave(100000, 0.01);
    const CleanScan scan = clean_scan(points, 5);
    EXPECT_NEAR(scan.scatter, 0.01, 0.002);
    EXPECT_LT(scan.rejected.size(), 20U);
}

TEST(CleanScan, SmoothProfilesAreKept) {
    EXPECT_TRUE(clean_scan(wave(1000, 0), 5).rejected.empty());
    std::vector<ScanPoint> line, steps, fillet;
    for (int i = 0; i < 300; ++i) {
        const double x = 0.1 * i;
        line.push_back({x, 100 - 3 * x});
        steps.push_back({x, std::round(20 * std::sin(x)) / 100});  // an instrument with a resolution of 0.01 mm
        const double in = std::clamp(x - 10, 0.0, 4.0);            // a plane, a fillet of 5 mm, a slope
        fillet.push_back({x, 5 - std::sqrt(25 - in * in) + std::max(0.0, x - 14) * 4 / 3});
    }
    EXPECT_TRUE(clean_scan(line, 5).rejected.empty());
    EXPECT_TRUE(clean_scan(steps, 5).rejected.empty());
    EXPECT_TRUE(clean_scan(fillet, 5).rejected.empty());
}

TEST(CleanScan, TheSamePlaceScannedTwiceIsOne) {
    const std::vector<ScanPoint> points{{0, 1}, {1, 2}, {1, 4}, {2, 3}};
    const CleanScan scan = clean_scan(points, 5);
    EXPECT_EQ(scan.x, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(scan.z, (std::vector<double>{1, 3, 3}));
    EXPECT_EQ(scan.averaged, 2U);
}

}  // namespace
}  // namespace clsurf::clean_scan_test
