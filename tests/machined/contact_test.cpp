#include "machined/contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clsurf::contact_test {
namespace {

const CuttingTool ball{ToolKind::ball, 3, 3};
const CuttingTool bull{ToolKind::bull, 5, 1};
const CuttingTool flat{ToolKind::flat, 4, 0};
/// A 3-4-5 triangle: the surface falls towards +x, so the contact is at −x of the tool.
const Vec3 tilted(0.6, 0, 0.8);

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " is not " << b.transpose();
}

TEST(Contact, OnALevelSurfaceItIsTheTip) {
    for (const CuttingTool& tool : {ball, bull, flat}) expect_near(contact_offset(tool, Vec3::UnitZ()), Vec3::Zero());
}

TEST(Contact, OnASlopeItLiesAgainstTheNormal) {
    // Ball: centre (0, 0, 3), and 3 against the normal: (−1.8, 0, 3 − 2.4).
    expect_near(contact_offset(ball, tilted), Vec3(-1.8, 0, 0.6));
    // Bull: tube's centre (−4, 0, 1), and 1 against the normal.
    expect_near(contact_offset(bull, tilted), Vec3(-4.6, 0, 0.2));
    // Flat: the edge, at the height of the tip.
    expect_near(contact_offset(flat, tilted), Vec3(-4, 0, 0));
}

TEST(Contact, OnAWallItIsAtTheToolsSide) {
    expect_near(contact_offset(ball, Vec3::UnitY()), Vec3(0, -3, 3));
    expect_near(contact_offset(bull, Vec3::UnitY()), Vec3(0, -5, 1));
    expect_near(contact_offset(flat, Vec3::UnitY()), Vec3(0, -4, 0));
}

TEST(Contact, HowDeepAPlaceLiesInsideTheTool) {
    // On the axis, straight up; at 60° of the ball's outline, 10 µm along its normal.
    EXPECT_NEAR(depth_inside(ball, Vec3(0, 0, 0.01)), 0.01, 1e-12);
    EXPECT_NEAR(depth_inside(flat, Vec3(2, 1, 0.01)), 0.01, 1e-12);
    const Vec3 normal(0.5 * std::sqrt(3.0), 0, 0.5);
    EXPECT_NEAR(depth_inside(ball, contact_offset(ball, normal) + 0.01 * normal), 0.01, 1e-4);
    EXPECT_NEAR(depth_inside(bull, contact_offset(bull, normal) + 0.01 * normal), 0.01, 2e-4);
    EXPECT_LT(depth_inside(ball, contact_offset(ball, normal) - 0.01 * normal), 0);
    EXPECT_LT(depth_inside(ball, Vec3(4, 0, 1)), 0);
}

TEST(Contact, ItLiesOnTheOutline) {
    for (const CuttingTool& tool : {ball, bull, flat}) {
        for (const double angle : {0.1, 0.7, 1.3}) {
            const Vec3 c = contact_offset(tool, Vec3(std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle)));
            EXPECT_NEAR(outline_height(tool, c.head<2>().norm()), c.z(), 1e-7);
        }
    }
}

TEST(Contact, TheOutlineEndsAtTheRadius) {
    EXPECT_EQ(outline_height(bull, 4), 0);
    EXPECT_NEAR(outline_height(bull, 4.6), 0.2, 1e-12);  // 1 − √(1 − 0.36)
    EXPECT_EQ(outline_height(flat, 3.9), 0);
    for (const CuttingTool& tool : {ball, bull, flat})
        EXPECT_EQ(outline_height(tool, 5.01), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace clsurf::contact_test
