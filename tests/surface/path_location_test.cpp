#include "surface/path_location.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf::path_location_test {
namespace {

TEST(PathLocation, NumbersAreLinearBetweenThePoints) {
    const std::vector<double> values{1, 3, -5};
    EXPECT_DOUBLE_EQ(interpolate(values, {0, 0.25F}), 1.5);
    EXPECT_DOUBLE_EQ(interpolate(values, {1, 0.5F}), -1);
    Column<float> column(2);
    column[0] = 2;
    column[1] = 4;
    EXPECT_FLOAT_EQ(interpolate(column, {0, 0.75F}), 3.5F);
}

TEST(PathLocation, VectorsAreLinearBetweenThePoints) {
    const auto corner = [](PointIndex i) { return i == 4 ? Vec3(1, 0, 0) : Vec3(0, 0, 2); };
    EXPECT_LT((interpolate(corner, {4, 0.5F}) - Vec3(0.5, 0, 1)).norm(), 1e-15);
}

TEST(PathLocation, AtAPointTheNextOneIsNotRead) {
    PointIndex last_read = -1;
    const auto value_of = [&](PointIndex i) {
        last_read = i;
        return 7.0;
    };
    EXPECT_EQ(interpolate(value_of, {9, 0}), 7.0);
    EXPECT_EQ(last_read, 9);
}

}  // namespace
}  // namespace clsurf::path_location_test
