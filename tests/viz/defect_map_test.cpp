#include "viz/defect_map.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace clsurf::viz::defect_map_test {
namespace {

/// Twice the signed area of a triangle.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return area(a, b, c) * area(a, b, d) < 0 && area(c, d, a) * area(c, d, b) < 0;
}

TEST(AssignSlots, LeadersNeverCrossAndEverySlotIsUsedOnce) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> across(0, 900);
    for (int round = 0; round < 500; ++round) {
        const std::size_t n = 2 + random() % 11;
        std::vector<Vec2> anchors(n);
        for (Vec2& anchor : anchors) anchor = Vec2(across(random), across(random));
        std::vector<double> slots(n);
        for (std::size_t k = 0; k < n; ++k) slots[k] = 800 - 40.0 * static_cast<double>(k);
        const std::vector<std::size_t> slot_of = assign_slots(anchors, slots, 1000);
        EXPECT_EQ(std::set<std::size_t>(slot_of.begin(), slot_of.end()).size(), n);
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = a + 1; b < n; ++b)
                EXPECT_FALSE(
                    cross(anchors[a], Vec2(1000, slots[slot_of[a]]), anchors[b], Vec2(1000, slots[slot_of[b]])))
                    << "round " << round;
        }
    }
}

TEST(AssignSlots, OrderOfHeightsAloneWouldCross) {
    // The lower anchor lies to the right, close to the slots: in order of heights its leader would be cut by the other one.
    const std::vector<Vec2> anchors{{0, 10}, {90, 9}};
    const std::vector<std::size_t> slot_of = assign_slots(anchors, {0, -100}, 100);
    EXPECT_EQ(slot_of, (std::vector<std::size_t>{1, 0}));
}

TEST(TopOfNames, IsBesideTheAnchorsAndInTheRoom) {
    const std::vector<Vec2> anchors{{0, 90}, {0, 110}};
    EXPECT_DOUBLE_EQ(top_of_names(anchors, 60, 0, 1000), 130);   // from 70 to 130
    EXPECT_DOUBLE_EQ(top_of_names(anchors, 60, 80, 1000), 140);  // as low as it can be
    EXPECT_DOUBLE_EQ(top_of_names(anchors, 60, 0, 120), 120);    // as high as it can be
    EXPECT_DOUBLE_EQ(top_of_names({}, 0, 0, 500), 500);          // "3 outside the picture" stands at the top
}

}  // namespace
}  // namespace clsurf::viz::defect_map_test
