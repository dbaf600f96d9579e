#include "surface/passes.h"

#include <gtest/gtest.h>

#include "support/made_path.h"
#include "surface/step_over.h"
#include "surface/stitch.h"

namespace clsurf::passes_test {
namespace {

TEST(StepOver, IsFoundOnAZigzagAndASpiral) {
    const Positions z = test::zigzag(12, 20, 0.4, 0.05);
    EXPECT_NEAR(estimate_step_over(z, test::one_run(z), ArcLength(z)), 0.4, 0.01);
    const Positions s = test::spiral(10, 15, 0.3, 0.05);
    EXPECT_NEAR(estimate_step_over(s, test::one_run(s), ArcLength(s)), 0.3, 0.01);
}

TEST(StepOver, IsNoneForASinglePass) {
    Positions p;
    test::add_line(p, {0, 0, 0}, {50, 0, 0}, 0.05);
    EXPECT_EQ(estimate_step_over(p, test::one_run(p), ArcLength(p)), 0.0);
}

TEST(Passes, OfAZigzagEndAtItsCorners) {
    const Positions p = test::zigzag(9, 20, 0.4, 0.05);
    const Passes passes = find_passes(p, ArcLength(p), test::one_run(p), 0.4);
    std::size_t cuts = 0;
    PointIndex covered = 0;
    for (const Pass& pass : passes) {
        covered += pass.size();
        if (pass.kind != PassKind::cut) continue;
        ++cuts;
        EXPECT_NEAR(std::abs(p[pass.last].x() - p[pass.first].x()), 20.0F, 0.15F);
        EXPECT_NEAR(p[pass.first].y(), p[pass.last].y(), 0.06F);
    }
    EXPECT_EQ(cuts, 9u);
    EXPECT_EQ(covered, p.size());
}

TEST(Passes, AreNotCutWhereTheSpeedIsLow) {
    // The same path with points a hundred times as dense around a corner of 90°.
    Positions p;
    test::add_line(p, {0, 0, 0}, {10, 0, 0}, 0.05);
    test::add_line(p, {10, 0, 0}, {10.2, 0, 0}, 0.0005);
    test::add_line(p, {10.2, 0, 0}, {10.2, 10, 0}, 0.05);
    const Passes passes = find_passes(p, ArcLength(p), test::one_run(p), 0.4);
    EXPECT_EQ(passes.size(), 1u);
}

// 100 points of a contour and a few of finishing: a picture also shows the contour.
TEST(ShowAllCutting, WhereFinishingIsLessThanATenth) {
    ClSurface surface;
    test::add_line(surface.positions, {0, 0, 0}, {11, 0, 0}, 0.1);
    for (const Pass& pass :
         {Pass{0, 99, PassKind::other}, Pass{100, 101, PassKind::rapid}, Pass{102, 109, PassKind::cut}})
        surface.passes.push_back(pass);
    surface.not_finishing = 100;
    surface.step_over = 0.005;
    ClSurface finishing = surface;
    show_all_cutting(surface);
    EXPECT_EQ(surface.passes[0].kind, PassKind::cut);
    EXPECT_EQ(surface.passes[1].kind, PassKind::rapid);
    EXPECT_EQ(surface.step_over, 0);
    EXPECT_EQ(surface.not_finishing, 0);
    finishing.passes[0].last = 89;
    finishing.passes[1] = {90, 91, PassKind::rapid};
    finishing.passes[2].first = 92;
    finishing.not_finishing = 90;  // of 108
    show_all_cutting(finishing);
    EXPECT_EQ(finishing.passes[0].kind, PassKind::other);
    EXPECT_EQ(finishing.step_over, 0.005);
}

}  // namespace
}  // namespace clsurf::passes_test
