#include "predictor/outline.h"

#include <gtest/gtest.h>

#include "support/made_surface.h"

namespace clsurf::outline_test {
namespace {

constexpr double apart = 0.4;  ///< [mm] between passes
constexpr double length = 30;  ///< [mm] of a pass
constexpr double from = 10;    ///< [mm]: the defect's section of every pass …
constexpr double to = 20;      ///< … along X

/// A flat zigzag, and a defect on some of its passes.
class Outline : public testing::Test {
protected:
    [[nodiscard]] std::vector<std::vector<Vec3>> of_passes(std::initializer_list<std::size_t> passes) const {
        return of_passes(passes, made_);
    }

    static std::vector<std::vector<Vec3>> of_passes(std::initializer_list<std::size_t> passes,
                                                    const test::MadeSurface& made) {
        Defect defect;
        for (const std::size_t k : passes) {
            DefectSection run;
            run.points = {std::numeric_limits<PointIndex>::max(), -1};
            const Pass& pass = cut(made, k);
            for (PointIndex i = pass.first; i <= pass.last; ++i) {
                const double x = made.surface.positions.absolute(i).x();
                if (x < from || x > to) continue;
                run.points = {std::min(run.points.first, i), std::max(run.points.last, i)};
            }
            defect.sections.push_back(run);
        }
        return outlines_of(defect, made.surface);
    }

    static double length_of(const std::vector<std::vector<Vec3>>& lines) {
        double sum = 0;
        for (const std::vector<Vec3>& line : lines) {
            for (std::size_t k = 1; k < line.size(); ++k) sum += (line[k] - line[k - 1]).norm();
        }
        return sum;
    }

    static Box3 bounds_of(const std::vector<std::vector<Vec3>>& lines) {
        Box3 box;
        for (const std::vector<Vec3>& line : lines) {
            for (const Vec3& p : line) box.extend(p);
        }
        return box;
    }

private:
    static const Pass& cut(const test::MadeSurface& made, std::size_t k) {
        std::size_t seen = 0;
        for (const Pass& pass : made.surface.passes) {
            if (pass.kind == PassKind::cut && seen++ == k) return pass;
        }
        throw std::out_of_range("no such pass");
    }

    const test::MadeSurface made_ = test::flat_zigzag(12, length, apart, 50, {});
};

TEST_F(Outline, OnePassHasARectangleHalfAStepOverWideOnEachSide) {
    const auto lines = of_passes({5});
    EXPECT_NEAR(length_of(lines), 2 * (to - from) + 2 * apart, 0.1);
    const Box3 box = bounds_of(lines);
    EXPECT_NEAR(box.min().y(), 4.5 * apart, 0.01);
    EXPECT_NEAR(box.max().y(), 5.5 * apart, 0.01);
    EXPECT_NEAR(box.min().x(), from, 0.1);
    EXPECT_NEAR(box.max().x(), to, 0.1);
}

TEST_F(Outline, PassesBesideEachOtherHaveNoLineBetweenThem) {
    EXPECT_NEAR(length_of(of_passes({4, 5, 6})), 2 * (to - from) + 6 * apart, 0.2);
}

TEST_F(Outline, ACleanPassBetweenTwoIsInside) {
    const auto lines = of_passes({4, 6});
    EXPECT_NEAR(length_of(lines), 2 * (to - from) + 6 * apart, 0.4);
    EXPECT_NEAR(bounds_of(lines).sizes().y(), 3 * apart, 0.01);
}

TEST_F(Outline, TwoCleanPassesBetweenPartIt) {
    EXPECT_NEAR(length_of(of_passes({3, 6})), 2 * (2 * (to - from) + 2 * apart), 0.2);
}

TEST_F(Outline, TheOutermostPassHasAnOuterSideToo) {
    const Box3 box = bounds_of(of_passes({0}));
    EXPECT_NEAR(box.min().y(), -0.5 * apart, 0.01);
}

TEST_F(Outline, DoesNotReachIntoTheGapOfAMissingPass) {
    const auto parted = [](const Vec3& flat) { return Vec3(flat + Vec3(0, flat.y() > 5.5 * apart ? apart : 0, 0)); };
    const test::MadeSurface made = test::flat_zigzag(12, length, apart, 50, {}, parted);
    const auto lines = of_passes({4, 5, 6, 7}, made);
    EXPECT_NEAR(length_of(lines), 4 * (to - from) + 6 * apart, 0.3) << "one outline on each side of the gap";
    for (const std::vector<Vec3>& line : lines) {
        for (const Vec3& p : line) {
            EXPECT_TRUE(p.y() < 5.01 * apart || p.y() > 6.99 * apart) << "in the gap at y = " << p.y();
        }
    }
}

}  // namespace
}  // namespace clsurf::outline_test
