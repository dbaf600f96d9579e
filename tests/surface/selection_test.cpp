#include "surface/selection.h"

#include <gtest/gtest.h>

namespace clsurf::selection_test {
namespace {

/// Two adjacent passes of five points, with a link of two between them.
ClSurface two_passes() {
    ClSurface surface;
    for (int i = 0; i < 12; ++i) {
        surface.positions.x.push_back(static_cast<float>(i < 6 ? i : 11 - i));
        surface.positions.y.push_back(i < 6 ? 0.0F : 1.0F);
        surface.positions.z.push_back(0);
        surface.neighbours.left.push_back(i < 5 || i > 6 ? 11 - 2 * i : Adjacency::none);
        surface.neighbours.right.push_back(Adjacency::none);
    }
    for (const Pass& pass : {Pass{0, 4, PassKind::cut}, Pass{5, 6, PassKind::link}, Pass{7, 11, PassKind::cut}})
        surface.passes.push_back(pass);
    return surface;
}

TEST(Selection, LeavesPassesInsideItsRanges) {
    ClSurface surface = two_passes();
    keep_points(surface, {{3, 8}, {10, 10}});
    ASSERT_EQ(surface.passes.size(), 7U);
    const Pass expected[] = {{0, 2, PassKind::rapid},  {3, 4, PassKind::cut},   {5, 6, PassKind::link},
                             {7, 8, PassKind::cut},    {9, 9, PassKind::rapid}, {10, 10, PassKind::cut},
                             {11, 11, PassKind::rapid}};
    for (std::size_t k = 0; k < 7; ++k) {
        EXPECT_EQ(surface.passes[k].first, expected[k].first);
        EXPECT_EQ(surface.passes[k].last, expected[k].last);
        EXPECT_EQ(surface.passes[k].kind, expected[k].kind);
    }
}

TEST(Selection, NobodyHasANeighbourOutside) {
    ClSurface surface = two_passes();
    keep_points(surface, {{1, 8}});
    EXPECT_FALSE(surface.neighbours.has(Side::left, 0)) << "outside itself";
    EXPECT_FALSE(surface.neighbours.has(Side::left, 1)) << "its neighbour, 10, is outside";
    EXPECT_TRUE(surface.neighbours.has(Side::left, 3));
    EXPECT_EQ(surface.neighbours.neighbour(Side::left, 3), 8);
    EXPECT_TRUE(surface.neighbours.has(Side::left, 8));
    EXPECT_FALSE(surface.neighbours.has(Side::left, 11));
}

TEST(Selection, StepOverMovesOutsideAreNone) {
    ClSurface surface = two_passes();
    surface.step_over_moves = {{1, 2}, {4, 5}, {9, 10}};
    keep_points(surface, {{3, 4}, {6, 11}});
    EXPECT_EQ(surface.step_over_moves, (std::vector<PointRange>{{4, 4}, {9, 10}}));
}

TEST(Selection, NothingIsLeftOfNoRange) {
    ClSurface surface = two_passes();
    keep_points(surface, {});
    for (const Pass& pass : surface.passes) EXPECT_EQ(pass.kind, PassKind::rapid);
}

TEST(Selection, IntersectsRanges) {
    const std::vector<PointRange> both = intersection({{0, 4}, {6, 9}, {20, 30}}, {{3, 7}, {9, 25}});
    EXPECT_EQ(both, (std::vector<PointRange>{{3, 4}, {6, 7}, {9, 9}, {20, 25}}));
    EXPECT_TRUE(intersection({{0, 4}}, {{5, 4}}).empty()) << "an empty range";
}

TEST(Selection, CountsCutPassesFromOne) {
    EXPECT_EQ(points_of_passes(two_passes().passes, 2, 9), (std::vector<PointRange>{{7, 11}}));
    EXPECT_EQ(points_of_passes(two_passes().passes, 1, 1), (std::vector<PointRange>{{0, 4}}));
}

}  // namespace
}  // namespace clsurf::selection_test
