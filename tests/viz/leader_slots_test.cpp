#include "viz/leader_slots.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace clsurf::viz::leader_slots_test {
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
        const std::vector<std::size_t> slot_of = assign_slots(anchors, slots, 1000, 0);
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
    // The lower anchor is to the right, close to the slots: in order of heights its leader would cross the other one.
    const std::vector<Vec2> anchors{{0, 10}, {90, 9}};
    const std::vector<std::size_t> slot_of = assign_slots(anchors, {0, -100}, 100, 0);
    EXPECT_EQ(slot_of, (std::vector<std::size_t>{1, 0}));
}

TEST(AssignSlots, ALeaderKeepsClearOfOtherAnchors) {
    // In order of heights the leader of the left anchor would cross the right one.
    const std::vector<Vec2> anchors{{0, 50}, {50, 39}};
    const std::vector<double> slots{30, 0};
    EXPECT_EQ(assign_slots(anchors, slots, 100, 0), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(assign_slots(anchors, slots, 100, 5), (std::vector<std::size_t>{1, 0}));
}

TEST(PlaceNames, MovesTheColumnWhereNoOrderIsClear) {
    // The three are at the height of the middle slot.
    const std::vector<Vec2> anchors{{0, 500}, {300, 500}, {600, 500}};
    const NameColumn column = place_names(anchors, 40, 0, 1000, 1000, 10);
    for (std::size_t a = 0; a < anchors.size(); ++a) {
        const Vec2 end(1000, column.slots[column.slot_of[a]]);
        for (std::size_t b = 0; b < anchors.size(); ++b) {
            if (b <= a) continue;  // the others come after it
            const double share = (anchors[b].x() - anchors[a].x()) / (end.x() - anchors[a].x());
            const Vec2 beside = anchors[a] + share * (end - anchors[a]);
            EXPECT_GE((beside - anchors[b]).norm(), 10) << a << ' ' << b;
        }
    }
}

TEST(TopOfNames, IsBesideTheAnchorsAndInTheRoom) {
    const std::vector<Vec2> anchors{{0, 90}, {0, 110}};
    EXPECT_DOUBLE_EQ(top_of_names(anchors, 60, 0, 1000), 130);   // from 70 to 130
    EXPECT_DOUBLE_EQ(top_of_names(anchors, 60, 80, 1000), 140);  // as low as it can be
    EXPECT_DOUBLE_EQ(top_of_names(anchors, 60, 0, 120), 120);    // as high as it can be
    EXPECT_DOUBLE_EQ(top_of_names({}, 0, 0, 500), 500);          // "3 outside the picture" stands at the top
}

}  // namespace
}  // namespace clsurf::viz::leader_slots_test
