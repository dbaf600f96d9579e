#include "predictor/signals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "predictor/mismatch.h"
#include "support/made_surface.h"
#include "surface/smoothing_segments.h"

namespace clsurf::signals_test {
namespace {

using test::MadeSurface;

/// Points on passes, away from their ends, at constant speed.
template <typename F>
void for_each_inner(const Signals& s, F&& f) {
    std::int64_t seen = 0;
    for (PointIndex i = 0; i < s.size(); ++i) {
        if (s[i].zone < Zone::near_end) continue;
        f(i);
        ++seen;
    }
    EXPECT_GT(seen, 1000);
}

TEST(Signals, ALagAlongThePathIsNoHeight) {
    // 20 ms at 50 mm/s: one millimetre behind, exactly on the path.
    const MadeSurface made =
        test::flat_zigzag(9, 30, 0.4, 50, [](const Vec3& p, const Vec3& feed) { return Vec3(p - 1.0 * feed); });
    const Signals s = made.signals();
    for_each_inner(s, [&](PointIndex i) {
        const float lag = s[i].normal_deviation;
        if (lag == lag) { EXPECT_NEAR(lag, 0.0F, 1e-6F) << i; }
    });
}

TEST(Signals, AnOffsetAlongTheNormalIsTheHeight) {
    const MadeSurface made = test::flat_zigzag(
        9, 30, 0.4, 50, [](const Vec3& p, const Vec3& feed) { return Vec3(p - 0.3 * feed + Vec3(0, 0, 0.005)); });
    const Signals s = made.signals();
    std::int64_t with = 0;
    for_each_inner(s, [&](PointIndex i) {
        const float lag = s[i].normal_deviation;
        if (!(lag == lag)) return;  // the outermost passes do have a normal, but from one side only
        EXPECT_NEAR(lag, 0.005F, 1e-6F) << i;
        ++with;
    });
    EXPECT_GT(with, 3000);
}

// Equal bit by bit, in any order of reading, and again after they were forgotten.
TEST(Signals, AreTheSameWhenTheyAreDerivedWhereTheyAreRead) {
    MadeSurface made = test::flat_zigzag(200, 30, 0.4, 50, [](const Vec3& p, const Vec3& feed) {
        return Vec3(p - 0.3 * feed + Vec3(0, 0, 0.005 * std::sin(p.x())));
    });
    const Signals whole = made.signals();
    ASSERT_GT(whole.size(), 5 * block_points);
    std::vector<PointRange> pieces;
    for (const Pass& pass : made.surface.passes) pieces.push_back({pass.first, pass.last});
    const ArcLength arc_length(made.surface.positions);
    const SignalFacts facts = measure_facts(made.surface, made.path, &made.measured, pieces);
    const Vec3 origin = made.surface.positions.origin;
    made.surface.positions = gather_when_read(made.path, origin, arc_length.sums());
    Signals read = derive_when_read(made.surface, made.path, &made.measured, pieces, 1.0, facts);
    EXPECT_EQ(read.quantum, whole.quantum);
    EXPECT_EQ(read.speed_noise, whole.speed_noise);
    EXPECT_EQ(read.acceleration_noise, whole.acceleration_noise);
    const auto same = [](float a, float b) { return a == b || (a != a && b != b); };
    for (int round = 0; round < 2; ++round) {
        for (PointIndex k = 0; k < whole.size(); ++k) {
            const PointIndex i = (k * 7919) % whole.size();
            const Sample &a = whole[i], &b = read[i];
            ASSERT_EQ(a.zone, b.zone) << i;
            ASSERT_TRUE(same(a.speed, b.speed) && same(a.normal_deviation, b.normal_deviation) &&
                        same(a.relief, b.relief))
                << i;
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_TRUE(same(a.feed[axis], b.feed[axis]) && same(a.normal[axis], b.normal[axis]) &&
                            same(a.acceleration[axis], b.acceleration[axis]))
                    << i;
            }
        }
        read.forget();
    }
}

TEST(Signals, TheNormalPointsUpWhicheverArcLengthThePassRuns) {
    const MadeSurface made = test::flat_zigzag(9, 30, 0.4, 50, {});
    const Signals s = made.signals();
    EXPECT_FALSE(s.measured);
    for_each_inner(s, [&](PointIndex i) { EXPECT_NEAR(s.normal(i).z(), 1.0F, 1e-5F); });
}

TEST(Signals, SpeedAndAccelerationAreThoseOfTheArcLength) {
    const MadeSurface made = test::flat_zigzag(9, 30, 0.4, 50, {});
    const Signals s = made.signals();
    for_each_inner(s, [&](PointIndex i) {
        EXPECT_NEAR(s[i].speed, 50.0F, 1e-2F);
        EXPECT_NEAR(s.acceleration(i).norm(), 0.0F, 1.0F);
    });
}

TEST(Signals, OfShortPassesATenthIsLeftOutAtEitherEnd) {
    for (const auto& [passes_length, left_out] : {std::pair(3.0, 0.3), std::pair(30.0, 1.0)}) {
        const MadeSurface made = test::flat_zigzag(9, passes_length, 0.05, 5, {});
        const Signals s = made.signals();
        for (PointIndex i = made.passes[4].first; i <= made.passes[4].last; ++i) {
            const double x = made.surface.positions.absolute(i).x(), to_end = std::min(x, passes_length - x);
            if (std::abs(to_end - left_out) < 0.02) continue;
            EXPECT_EQ(s[i].zone == Zone::outside, to_end < left_out) << x << " of " << passes_length;
        }
    }
}

TEST(Signals, OfShortPassesTwoStepOversAreLeftOutAtLeast) {
    const MadeSurface made = test::flat_zigzag(9, 3.0, 0.4, 5, {});
    const Signals s = made.signals();
    for (PointIndex i = made.passes[4].first; i <= made.passes[4].last; ++i) {
        const double x = made.surface.positions.absolute(i).x(), to_end = std::min(x, 3.0 - x);
        if (std::abs(to_end - 0.8) < 0.02) continue;
        EXPECT_EQ(s[i].zone == Zone::outside, to_end < 0.8) << x;
    }
}

TEST(Mismatch, OfASlowerPassIsWhatItIsSlower) {
    // Pass 4 runs at 45 mm/s, all others at 50.
    const MadeSurface made = test::zigzag_of_speeds({50, 50, 50, 50, 45, 50, 50, 50, 50}, 30, 0.4);
    const Signals s = made.signals();
    const Comparer comparer(made.surface, s, 50);
    std::array<int, 3> seen{};
    for_each_inner(s, [&](PointIndex i) {
        const int pass = static_cast<int>(std::lround(made.surface.positions[i].y() / 0.4F));
        const Comparison c = comparer.compare({i, 0});
        if (c.left == 0 || c.right == 0) return;  // next to where the adjacent pass begins
        const float step = c.step[index_of(Quantity::speed)];
        const float residual = c.residual[index_of(Quantity::speed)];
        if (pass == 4) {
            EXPECT_NEAR(step, 0.10F, 1e-3F);
            EXPECT_NEAR(residual, -0.10F, 1e-3F);
            EXPECT_NEAR(c.speed_jump, -5.0F, 0.05F);
            ++seen[0];
        } else if (pass == 3 || pass == 5) {
            EXPECT_NEAR(step, 0.10F, 1e-3F);     // the step is on both sides of it …
            EXPECT_NEAR(residual, 0.0F, 1e-3F);  // … and the fault is not on these passes
            ++seen[1];
        } else if (pass == 2 || pass == 6) {
            EXPECT_NEAR(step, 0.0F, 1e-3F);
            EXPECT_NEAR(residual, 0.0F, 1e-3F);
            ++seen[2];
        }
    });
    for (const int n : seen) EXPECT_GT(n, 400);
}

TEST(Mismatch, ThatChangesEvenlyFromPassToPassIsNobodysFault) {
    const MadeSurface made = test::zigzag_of_speeds({40, 42, 44, 46, 48, 50, 52, 54, 56}, 30, 0.4);
    const Signals s = made.signals();
    const Comparer comparer(made.surface, s, 50);
    for_each_inner(s, [&](PointIndex i) {
        const Comparison c = comparer.compare({i, 0});
        if (c.left == 0 || c.right == 0) return;
        EXPECT_NEAR(c.residual[index_of(Quantity::speed)], 0.0F, 1e-3F) << i;
    });
}

TEST(Signals, AMeasuredPathOutsideAWallRunsAboveItWhicheverWayTheToolRuns) {
    for (const double draft : {0.02, 0.1, 0.25}) {
        const Vec3 outwards(0, -std::cos(draft), std::sin(draft));
        const test::MadeSurface made = test::flat_zigzag(
            11, 30, 0.3, 50, [&](const Vec3& commanded, const Vec3&) { return Vec3(commanded + 0.01 * outwards); },
            [&](const Vec3& flat) { return Vec3(flat.x(), flat.y() * std::sin(draft), flat.y() * std::cos(draft)); });
        const Signals signals = made.signals();
        int seen = 0;
        for (PointIndex i = 0; i < signals.size(); ++i) {
            if (signals[i].zone == Zone::outside || std::isnan(signals[i].normal_deviation)) continue;
            EXPECT_NEAR(signals[i].normal_deviation, 0.01F, 1e-4F);
            ++seen;
        }
        EXPECT_GT(seen, 1000);
    }
}

}  // namespace
}  // namespace clsurf::signals_test
