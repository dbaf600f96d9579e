#include "machined/as_machined_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/parallel.h"
#include "machined/form.h"
#include "machined/local_quadratic.h"
#include "machined/roughness.h"
#include "machined/scallop.h"
#include "machined/ungouged_contacts.h"
#include "support/made_surface.h"

namespace clsurf::as_machined_surface_test {
namespace {

using test::MadeSurface;

/// A made surface and its as-machined surface.
struct Made {
    MadeSurface made;
    Signals signals;
    std::vector<PointRange> pieces;

    explicit Made(MadeSurface surface) : made(std::move(surface)), signals(made.signals()) {
        for (const Pass& pass : made.surface.passes) pieces.push_back({pass.first, pass.last});
    }
    [[nodiscard]] AsMachinedSurface as_machined(const CuttingTool& tool) const {
        return {made.surface, signals, Role::commanded, made.has_measured ? made.measured : made.path, pieces, tool};
    }
};

CuttingTool ball(double radius) { return {ToolKind::ball, radius, radius}; }

/// One row of heights above z = 0, `step` apart.
std::vector<double> profile(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& along, double step,
                            std::int64_t count) {
    std::vector<double> z;
    as_machined.map({from, along, step, count, 1}, [&](std::int64_t, std::span<float> row) {
        for (const float height : row) z.push_back(height + as_machined.level());
    });
    return z;
}

std::vector<float> deviations(const AsMachinedSurface& as_machined, const MapFrame& frame) {
    const Form form(as_machined, frame.bounds(0, 0, frame.columns, frame.rows));
    std::vector<float> all;
    map_deviation(as_machined, form, frame,
                  [&](std::int64_t, std::span<float> rows) { all.insert(all.end(), rows.begin(), rows.end()); });
    return all;
}

double rise(const std::vector<double>& z) {
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    return *high - *low;
}

TEST(AsMachinedSurface, TheScallopOfABallIsTheClosedFormToOnePercent) {
    for (const double radius : {1.0, 3.0, 5.0, 8.0}) {
        for (const double apart : {0.1, 0.3, 0.5}) {
            const Made made(test::flat_zigzag(9, 6, apart, 40, {}));
            const std::vector<double> z =
                profile(made.as_machined(ball(radius)), Vec2(3.01, 2 * apart), Vec2::UnitY(), apart / 200, 801);
            const double closed = scallop_height(radius, apart, std::numeric_limits<double>::infinity());
            EXPECT_NEAR(rise(z), closed, 0.01 * closed) << radius << " " << apart;
        }
    }
}

TEST(AsMachinedSurface, OnAnInclinedPlaneTheScallopIsThatAcrossTheSlope) {
    constexpr double radius = 3;
    constexpr double apart = 0.3;
    const double closed = scallop_height(radius, apart, std::numeric_limits<double>::infinity());
    for (const double degrees : {10.0, 30.0, 50.0}) {
        for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3(1, 1, 0).normalized())}) {
            const Eigen::Matrix3d turn = Eigen::AngleAxisd(degrees * 0.017453292519943295, axis).toRotationMatrix();
            const Made made(test::flat_zigzag(15, 10, apart, 40, {}, [&](const Vec3& p) { return Vec3(turn * p); }));
            const AsMachinedSurface as_machined = made.as_machined(ball(radius));
            // Across the passes through the middle of the contacts.
            const Vec3 n = turn * Vec3::UnitZ();
            const Vec3 from = turn * Vec3(5, 4 * apart, 0) + radius * (Vec3::UnitZ() - n);
            const Vec3 to = turn * Vec3(5, 10 * apart, 0) + radius * (Vec3::UnitZ() - n);
            const Vec2 displacement = (to - from).head<2>();
            constexpr std::int64_t count = 1201;
            const MapFrame frame{from.head<2>(), displacement.normalized(), displacement.norm() / (count - 1), count,
                                 1};
            const std::vector<float> z = deviations(as_machined, frame);
            const auto [low, high] = std::minmax_element(z.begin(), z.end());
            EXPECT_NEAR(*high - *low, closed, 0.01 * closed) << degrees << " about " << axis.transpose();
            EXPECT_NEAR(*low, 0, 0.00002) << degrees << " about " << axis.transpose();
        }
    }
}

struct Envelope {
    double radius, apart;
    std::vector<double> offsets, z;  ///< z every half a step-over from the second pass to the eighth
    double ra, rq, rz;
};

// Profiles across passes with height offsets, from an independent implementation, tolerance 0.2 %.
const std::vector<Envelope> envelopes{
    {3.0,
     0.331,
     {0.0, 0.0, 0.01055, 0.0, 0.01659, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.00456852022951, 0.01055, 0.00456852022951, 0.0, 0.00456852022951, 0.01659, 0.00456852022951, 0.0,
      0.00456852022951, 0.0, 0.00456852022951, 0.0},
     0.00368977680843,
     0.00446582278442,
     0.0166301413082},
    {3.0,
     0.192,
     {0.0, 0.0, 0.0, 0.0, 0.01437, -0.01158, 0.0, 0.0, 0.0},
     {0.0, 0.00153639341746, 0.0, 0.00153639341746, 0.0, 0.00153639341746, -0.00542969562602, -0.0100436065825,
      -0.01158, -0.0100436065825, -0.00542969562602, 0.00153639341746, 0.0},
     0.00432260627839,
     0.00474923084464,
     0.0133060782196},
    {3.0,
     0.361,
     {0.0, 0.0, -0.00732, 0.0, 0.0, -0.00464, 0.0, 0.0, 0.0},
     {0.0, -0.00188503519292, -0.00732, -0.00188503519292, 0.0, 0.00543496480708, 0.0, 0.000794964807076, -0.00464,
      0.000794964807076, 0.0, 0.00543496480708, 0.0},
     0.00252085224065,
     0.00311299832877,
     0.0127549648071},
    {3.0,
     0.336,
     {0.0, 0.0, 0.01155, -0.00965, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.00470769373004, 0.00922537999499, -0.00494230626996, -0.00965, -0.00494230626996, 0.0, 0.00470769373004,
      0.0, 0.00470769373004, 0.0, 0.00470769373004, 0.0},
     0.00335920332268,
     0.0048397265446,
     0.0219045961186},
    {3.0,
     0.284,
     {0.0, 0.0, 0.0, 0.00834, 0.01297, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.00336255112501, 0.0, 0.00336255112501, 0.00834, 0.011702551125, 0.01297, 0.00336255112501, 0.0,
      0.00336255112501, 0.0, 0.00336255112501, 0.0},
     0.00367204310696,
     0.00434412815894,
     0.0144165646089},
};

TEST(AsMachinedSurface, PassesOfDifferentHeightsFormTheirEnvelope) {
    for (const Envelope& e : envelopes) {
        const Made made(test::flat_zigzag(9, 6, e.apart, 40, [&](const Vec3& p, const Vec3&) {
            return Vec3(p + Vec3(0, 0, e.offsets[static_cast<std::size_t>(std::lround(p.y() / e.apart))]));
        }));
        constexpr int per_pass = 400;
        const std::vector<double> z = profile(made.as_machined(ball(e.radius)), Vec2(3.01, e.apart), Vec2::UnitY(),
                                              e.apart / per_pass, 6 * per_pass + 1);
        for (std::size_t k = 0; k < e.z.size(); ++k)
            EXPECT_NEAR(z[k * per_pass / 2], e.z[k], 2e-6 + 0.002 * std::abs(e.z[k])) << k;
        const ProfileHeights h = profile_heights(z);
        EXPECT_NEAR(h.ra, e.ra, 2e-6 + 0.002 * e.ra);
        EXPECT_NEAR(h.rq, e.rq, 2e-6 + 0.002 * e.rq);
        EXPECT_NEAR(h.rz, e.rz, 2e-6 + 0.002 * e.rz);
    }
}

TEST(AsMachinedSurface, APitGoesThroughAndABulgeVanishesAtFourScallops) {
    constexpr double radius = 3;
    constexpr double apart = 0.3;
    const double h = scallop_height(radius, apart, std::numeric_limits<double>::infinity());
    const auto rise_with = [&](double offset) {
        const Made made(test::flat_zigzag(11, 6, apart, 40, [&](const Vec3& p, const Vec3&) {
            return Vec3(p + Vec3(0, 0, std::lround(p.y() / apart) == 5 ? offset : 0.0));
        }));
        return rise(profile(made.as_machined(ball(radius)), Vec2(3, 3 * apart), Vec2::UnitY(), apart / 400, 1601));
    };
    EXPECT_NEAR(rise_with(-0.005), h + 0.005, 0.00005);
    EXPECT_NEAR(rise_with(2 * h), h * 1.5 * 1.5, 0.01 * h);  // h (1 + δ/4h)²
    EXPECT_NEAR(rise_with(4 * h), 4 * h, 0.02 * h);
    EXPECT_NEAR(rise_with(9 * h), 4 * h, 0.02 * h);  // the pass does not cut at all
}

TEST(AsMachinedSurface, SegmentsAreSweptAndNotStampedAtTheirEnds) {
    // One point per millimetre: a ball placed only at the points would leave cusps of 42 µm along the feed.
    const Made made(test::flat_zigzag(9, 20, 0.3, 1000, {}));
    const std::vector<double> z = profile(made.as_machined(ball(3)), Vec2(5, 1.2), Vec2::UnitX(), 0.01, 1000);
    EXPECT_LT(rise(z), 1e-6);
    // Also down a slope along the feed.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix();
    const Made slope(test::flat_zigzag(9, 20, 0.3, 1000, {}, [&](const Vec3& p) { return Vec3(turn * p); }));
    const Vec2 from = (turn * Vec3(8, 1.2, 0) + 3 * (Vec3::UnitZ() - turn * Vec3::UnitZ())).head<2>();
    const std::vector<float> down = deviations(slope.as_machined(ball(3)), {from, Vec2::UnitX(), 0.01, 500, 1});
    for (std::size_t k = 0; k < down.size(); ++k) EXPECT_NEAR(down[k], 0, 2e-6) << k;
}

TEST(AsMachinedSurface, AFlatToolLeavesAPlaneAndABullCusps) {
    const auto pit = [](const Vec3& p, const Vec3&) {
        return Vec3(p + Vec3(0, 0, std::lround(p.y() / 2) == 4 ? -0.005 : 0.0));
    };
    const Made made(test::flat_zigzag(9, 30, 2, 40, pit));
    // A pit's groove is as wide as the flat tool.
    const AsMachinedSurface flat = made.as_machined({ToolKind::flat, 3, 0});
    const std::vector<double> z = profile(flat, Vec2(15, 4.51), Vec2::UnitY(), 0.05, 141);
    for (std::size_t k = 0; k < z.size(); ++k) {
        const double y = 4.51 + 0.05 * static_cast<double>(k);
        if (std::abs(std::abs(y - 8) - 3) < 0.06) continue;  // its wall
        EXPECT_NEAR(z[k], std::abs(y - 8) < 3 ? -0.005 : 0, 1e-7) << y;
    }
    // A tool with a flat of 2 mm half width in passes 4.4 mm apart: cusps of the corners 0.2 mm outside the flats.
    const Made wide(test::flat_zigzag(7, 30, 4.4, 100, {}));
    const std::vector<double> cusps =
        profile(wide.as_machined({ToolKind::bull, 3, 1}), Vec2(15, 8.8), Vec2::UnitY(), 0.01, 881);
    EXPECT_NEAR(rise(cusps), 1 - std::sqrt(1 - 0.04), 1e-5);
}

TEST(AsMachinedSurface, ABullOnASlopeLeavesWhatItsTorusDoes) {
    // Passes along the level lines of the slope: across them the circle of the torus cuts.
    constexpr double apart = 0.2;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vec3::UnitX()).toRotationMatrix();
    const Made made(test::flat_zigzag(15, 10, apart, 40, {}, [&](const Vec3& p) { return Vec3(turn * p); }));
    const CuttingTool tool{ToolKind::bull, 3, 1};
    const Vec3 n = turn * Vec3::UnitZ();
    const Vec3 off = Vec3::UnitZ() - n - 2 * Vec3(n.x(), n.y(), 0).normalized();
    const Vec3 from = turn * Vec3(5, 4 * apart, 0) + off;
    const double step = apart / 400 * std::cos(0.5);
    const std::vector<float> z = deviations(made.as_machined(tool), {from.head<2>(), Vec2::UnitY(), step, 2401, 1});
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    const double closed = scallop_height(1, apart, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(*high - *low, closed, 0.01 * closed);
}

TEST(AsMachinedSurface, WhatNoPassCutHasNoHeight) {
    const Made made(test::flat_zigzag(9, 6, 0.3, 40, {}));
    const AsMachinedSurface as_machined = made.as_machined(ball(3));
    // The outermost pass is at 2.4 mm. Beyond it is the flank of the tool, not the part …
    const std::vector<double> flank = profile(as_machined, Vec2(3, 2.5), Vec2::UnitY(), 0.1, 28);
    for (std::size_t k = 0; k < flank.size(); ++k) {
        const double off = 0.1 + 0.1 * static_cast<double>(k);
        EXPECT_NEAR(flank[k], 3 - std::sqrt(9 - off * off), 1e-5) << off;
    }
    for (const float z : deviations(as_machined, {Vec2(3, 2.8), Vec2::UnitY(), 0.1, 24, 1})) EXPECT_TRUE(std::isnan(z));
    // … and beyond the radius of the tool there is nothing.
    for (const double z : profile(as_machined, Vec2(3, 5.41), Vec2::UnitY(), 0.1, 20)) EXPECT_TRUE(std::isnan(z));
}

TEST(AsMachinedSurface, TheMapIsTheSameForAnyNumberOfThreads) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vec3(1, 2, 0).normalized()).toRotationMatrix();
    const Made made(test::flat_zigzag(40, 12, 0.3, 40, {}, [&](const Vec3& p) { return Vec3(turn * p); }));
    const AsMachinedSurface as_machined = made.as_machined(ball(3));
    const MapFrame frame = frame_of(as_machined.bounds(), as_machined.usual_cell());
    EXPECT_GT(frame.columns * frame.rows, 500'000);
    std::vector<float> maps[2];
    for (int k = 0; k < 2; ++k) {
        set_thread_count(k == 0 ? 1 : 4);
        maps[k] = deviations(as_machined, frame);
    }
    set_thread_count(0);
    EXPECT_EQ(std::memcmp(maps[0].data(), maps[1].data(), maps[0].size() * sizeof(float)), 0);
}

TEST(AsMachinedSurface, AHighLinkLeavesNothing) {
    const Made low(test::flat_zigzag(9, 6, 0.3, 40, {}));
    ClSurface lifted = low.made.surface;
    for (const Pass& pass : lifted.passes) {
        if (pass.kind != PassKind::link) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) lifted.positions.z[static_cast<std::size_t>(i)] += 2;
    }
    const AsMachinedSurface without(lifted, low.signals, Role::commanded, low.made.path, low.pieces, ball(3));
    const auto heights = [](const AsMachinedSurface& as_machined) {
        std::vector<float> all;
        as_machined.map(frame_of(Box2(Vec2(0, 0), Vec2(6, 2.4)), 0.05),
                        [&](std::int64_t, std::span<float> z) { all.insert(all.end(), z.begin(), z.end()); });
        return all;
    };
    const std::vector<float> with = heights(low.as_machined(ball(3))), high = heights(without);
    double most = 0;
    for (std::size_t k = 0; k < with.size(); ++k) {
        ASSERT_GE(high[k], with[k] - 1e-6F);
        most = std::max(most, static_cast<double>(high[k] - with[k]));
    }
    // Where a link led from pass to pass, the cusp between them remains, as without the link.
    EXPECT_NEAR(most, scallop_height(3, 0.3, std::numeric_limits<double>::infinity()), 2e-4);
}

/// Tips on a tent of 30° flanks: at its ridge the contacts of each flank extend R sin 30° beyond it, where
/// the passes of the other flank cut them away. The rest is the tent of both contact planes, R (1 − cos 30°)
/// below the tips along the normal to the flank.
Made tent() {
    constexpr double apart = 0.3;
    constexpr double middle = 25 * apart;
    return Made(test::flat_zigzag(51, 12, apart, 50, {}, [](const Vec3& flat) {
        return Vec3(flat.x(), (flat.y() - middle) * std::cos(M_PI / 6), -std::abs(flat.y() - middle) * 0.5);
    }));
}

TEST(UngougedContacts, AreThoseOfTheTentOnTheirOwnSideOfTheRidge) {
    // A contact e beyond the ridge is 2 e sin 30° = e inside the tools of the other flank, and the closest is 60 µm
    // beyond; one tip per 0.25 mm is tested, which misses up to 0.25²/8R = 3 µm. Of the pass along the ridge nothing remains.
    const Made made = tent();
    const AsMachinedSurface as_machined = made.as_machined(ball(3));
    const Box2 box(Vec2(2, -2.5), Vec2(10, 2.5));
    std::size_t expected = 0;
    for (const ContactPoint& contact : as_machined.contacts(box, 0.05))
        expected += contact.at.y() * contact.tip.y() > 1e-9 ? 1U : 0U;
    const std::vector<Vec3> standing = ungouged_contacts(as_machined, box, 0.05);
    EXPECT_GT(expected, 2000U);
    EXPECT_EQ(standing.size(), expected);
    for (const Vec3& at : standing)
        ASSERT_NEAR(at.z(), -std::abs(at.y()) * std::tan(M_PI / 6) - 3 * (1 / std::cos(M_PI / 6) - 1), 1e-6)
            << at.transpose();
}

TEST(LocalQuadratic, IsExactOnQuadraticsAndHardlyBentByOneRaisedPass) {
    const auto height = [](double x, double y) {
        return 0.3 - 0.2 * x + 0.1 * y + 0.05 * x * x - 0.02 * x * y + 0.04 * y * y;
    };
    const double expected[] = {0.3, -0.2, 0.1, 0.05, -0.02, 0.04};
    for (const double raised : {0.0, 0.01}) {
        LocalQuadratic quadratic;
        for (int row = -3; row <= 3; ++row) {
            for (int k = -12; k <= 12; ++k)
                quadratic.add(0.25 * k, row, height(0.25 * k, row) + (row == 1 ? raised : 0), 1);
        }
        const LocalQuadratic::Terms a = quadratic.fit(1e-4);
        for (Eigen::Index k = 0; k < 6; ++k) EXPECT_NEAR(a[k], expected[k], raised > 0 ? 0.1 * raised : 2e-6) << k;
    }
}

TEST(Form, WhatTheToolCutsAwayAgainIsNoForm) {
    const double c = std::cos(M_PI / 6);
    const double s = 0.5;
    const Made made = tent();
    const AsMachinedSurface as_machined = made.as_machined(ball(3));
    const Form form(as_machined, as_machined.bounds(), Form::Of::contacts);
    for (const double y : {-3.0, -1.5, -1.2, 1.2, 1.5, 3.0}) {
        const Form::Facet facet = form.at({6, y});
        EXPECT_NEAR(facet.z + as_machined.level(), -std::abs(y) * s / c - 3 * (1 - c) / c, 0.001) << y;
        EXPECT_NEAR(facet.zy, y < 0 ? s / c : -s / c, 0.01) << y;
    }
}

}  // namespace
}  // namespace clsurf::as_machined_surface_test
