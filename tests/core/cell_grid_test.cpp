#include "core/cell_grid.h"

#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::cell_grid_test {
namespace {

std::vector<CellGrid::Key> near(const CellGrid& grid, const Vec3& p) {
    std::vector<CellGrid::Key> keys;
    grid.for_each_near(p, [&](CellGrid::Key key) { keys.push_back(key); });
    return keys;
}

TEST(CellGrid, APlaceIsInTheCellOfItsFloors) {
    const CellGrid grid(0.5);
    EXPECT_EQ(grid.key({0, 0, 0}), grid.key({0.49, 0.01, 0.3}));
    EXPECT_NE(grid.key({0, 0, 0}), grid.key({-0.01, 0, 0})) << "zero divides two cells";
    EXPECT_NE(grid.key({0, 0, 0}), grid.key({0, 0.5, 0}));
    EXPECT_LT(grid.key({-3, 9, 9}), grid.key({0, -9, 9})) << "sorted by x first";
    EXPECT_LT(grid.key({0, -9, 9}), grid.key({0, 0, -9}));
}

TEST(CellGrid, WhatIsNearerThanACellIsInTheCellsAround) {
    std::mt19937_64 random(11);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int k = 0; k < 2000; ++k) {
        const double side = uniform(0.01, 10);
        const CellGrid grid(side);
        const Vec3 p(uniform(-500, 500), uniform(-500, 500), uniform(-500, 500));
        const Vec3 away = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized() * uniform(0, side);
        const std::vector<CellGrid::Key> keys = near(grid, p);
        EXPECT_EQ(std::set(keys.begin(), keys.end()).size(), 27U);
        EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
        EXPECT_EQ(std::count(keys.begin(), keys.end(), grid.key(p + away)), 1);
        EXPECT_EQ(std::count(keys.begin(), keys.end(), grid.key(p + 2.01 * side * Vec3::UnitY())), 0);
    }
}

TEST(CellGrid, PlacesTooFarAwayOrNotFiniteAreInOutermostCells) {
    const CellGrid grid(1e-3);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(grid.key({1e9, 0, 0}), grid.key({infinite, 0, 0}));
    EXPECT_EQ(grid.key({-1e300, 0, 0}), grid.key({-infinite, 0, 0}));
    EXPECT_EQ(grid.key({nan, 0, 0}), grid.key({-infinite, 0, 0}));
    for (const double x : {infinite, -infinite, nan}) {
        std::set<CellGrid::Key> keys;
        CellGrid::for_each_near(grid.key({x, x, x}), CellGrid::most_aside,
                                [&](CellGrid::Key key) { keys.insert(key); });
        EXPECT_EQ(keys.size(), 17U * 17U * 17U) << "none is the same as another one";
    }
}

}  // namespace
}  // namespace clsurf::cell_grid_test
