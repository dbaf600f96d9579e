#include "surface/adjacency.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "support/made_path.h"

namespace clsurf::adjacency_test {
namespace {

Adjacency neighbours_of(const Positions& p, double step_over) {
    const ArcLength arc_length(p);
    return find_neighbours(p, find_passes(p, arc_length, test::one_run(p), step_over), arc_length, step_over);
}

TEST(Adjacency, FindsBothNeighboursOfAZigzagBesideThePoint) {
    const Positions p = test::zigzag(9, 20, 0.4, 0.05);
    const Adjacency a = neighbours_of(p, 0.4);
    std::int64_t checked = 0;
    for (PointIndex i = 0; i < p.size(); ++i) {
        // Away from the turns and the outermost passes every point has two neighbours.
        const bool inner = p[i].x() > 1 && p[i].x() < 19 && p[i].y() > 0.3F && p[i].y() < 2.9F;
        if (!inner) continue;
        for (const Side side : {Side::left, Side::right}) {
            ASSERT_TRUE(a.has(side, i)) << i;
            const Eigen::Vector3f d = p[a.neighbour(side, i)] - p[i];
            EXPECT_NEAR(d.x(), 0.0F, 0.026F);
            EXPECT_NEAR(std::abs(d.y()), 0.4F, 1e-4F);
            ++checked;
        }
    }
    EXPECT_GT(checked, 4000);
}

TEST(Adjacency, RecordsMayBeFartherApartThanPasses) {
    // 250 mm/s at a period of 4 ms, passes 0.3 mm apart; and three times as fast.
    for (const double record : {1.0, 3.0}) {
        const Positions p = test::zigzag(15, 80, 0.3, record);
        const Adjacency a = neighbours_of(p, 0.3);
        for (PointIndex i = 0; i < p.size(); ++i) {
            const bool inner = p[i].x() > 4 && p[i].x() < 76 && p[i].y() > 0.2F && p[i].y() < 4.1F;
            if (!inner) continue;
            for (const Side side : {Side::left, Side::right}) {
                ASSERT_TRUE(a.has(side, i)) << i;
                const Eigen::Vector3f d = p[a.neighbour(side, i)] - p[i];
                EXPECT_LE(std::abs(d.x()), 0.51F * static_cast<float>(record));
                EXPECT_NEAR(std::abs(d.y()), 0.3F, 1e-4F);
            }
        }
    }
}

TEST(Adjacency, ASpiralIsItsOwnNeighbour) {
    const Positions p = test::spiral(10, 15, 0.3, 0.05);
    const Adjacency a = neighbours_of(p, 0.3);
    std::int64_t with = 0;
    std::int64_t all = 0;
    for (PointIndex i = 0; i < p.size(); ++i) {
        const float r = std::hypot(p[i].x(), p[i].y());
        if (r > 9.5F || r < 6.5F) continue;
        ++all;
        if (!a.has(Side::left, i) || !a.has(Side::right, i)) continue;
        ++with;
        EXPECT_NEAR((p[a.neighbour(Side::left, i)] - p[i]).norm(), 0.3F, 0.03F);
    }
    EXPECT_EQ(with, all);
}

TEST(Adjacency, IsTheSameForAnyNumberOfThreads) {
    const Positions p = test::zigzag(40, 60, 0.4, 0.02);
    set_thread_count(1);
    const Adjacency one = neighbours_of(p, 0.4);
    set_thread_count(4);
    const Adjacency four = neighbours_of(p, 0.4);
    set_thread_count(0);
    for (std::size_t i = 0; i < one.left.size(); ++i) {
        ASSERT_EQ(one.left[i], four.left[i]);
        ASSERT_EQ(one.right[i], four.right[i]);
    }
}

}  // namespace
}  // namespace clsurf::adjacency_test
