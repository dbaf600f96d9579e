// Places on parts of known shape: contact points and normals come from formulas of the surface, and the
// tips from them by the tool's geometry, written here independently. A search for them must find them.

#include "machined/contact_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "machined/place_search.h"
#include "support/stitched_path.h"

namespace clsurf::contact_points_test {
namespace {

struct SurfacePoint {
    Vec3 at, normal;
};
/// The part at u, v [mm].
using Shape = std::function<SurfacePoint(double u, double v)>;
/// The tool axis, from the normal, the direction of u and the place.
using Lean = std::function<Vec3(const SurfacePoint& p, const Vec3& along)>;

struct Columns {
    std::vector<double> x, y, z;
    void add(const Vec3& p) {
        x.push_back(p.x());
        y.push_back(p.y());
        z.push_back(p.z());
    }
    [[nodiscard]] Trajectory trajectory() const {
        Trajectory t;
        t.count = static_cast<PointIndex>(x.size());
        t.period = 0.001;
        t.axes = {view_of(x), view_of(y), view_of(z)};
        return t;
    }
};

constexpr double step_over = 0.3;
constexpr double spacing = 0.04;      ///< distance between points
constexpr double line_length = 0.25;  ///< length of the program's lines

/// Zigzag passes along u, v a step-over apart, 0.04 mm between points.
struct Milled {
    Columns tips;
    ToolAxes::Columns axes;
    std::vector<Vec3> contacts;
    std::vector<int> lines;
    std::vector<bool> turns;  ///< near a turn of the pass: not tested
    Trajectory path;
    std::optional<ToolAxes> tool_axes;
    ClSurface surface;

    Milled(const Shape& shape, const CuttingTool& tool, double u_size, double v_size, const Lean& lean = {}) {
        int line = 0;
        bool forth = true;
        for (double v = 0; v <= v_size; v += step_over, forth = !forth) {
            double gone = 0;
            ++line;
            for (double u = 0; u <= u_size; u += spacing, gone += spacing) {
                if (gone >= line_length) {
                    gone = 0;
                    ++line;
                }
                add(shape, tool, lean, forth ? u : u_size - u, v, line);
                turns.back() = u < step_over || u > u_size - step_over;
            }
            ++line;
            for (double w = 0.05; w < step_over; w += 0.05) add(shape, tool, lean, forth ? u_size : 0, v + w, line);
        }
        path = tips.trajectory();
        tool_axes.emplace(std::make_shared<const ToolAxes::Columns>(axes));
        surface = test::surface_of(gather(path), step_over);
    }

    void add(const Shape& shape, const CuttingTool& tool, const Lean& lean, double u, double v, int line) {
        const SurfacePoint p = shape(u, v);
        const Vec3 along = (shape(u + 1e-4, v).at - p.at).normalized();
        const Vec3 axis = lean ? lean(p, along) : Vec3(Vec3::UnitZ());
        // From the contact into the tube, to the middle of its circle, down to the tip.
        const Vec3 level = p.normal - p.normal.dot(axis) * axis;
        const Vec3 outwards = level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(Vec3::Zero());
        tips.add(p.at + tool.corner * p.normal + (tool.radius - tool.corner) * outwards - tool.corner * axis);
        for (int k = 0; k < 3; ++k) axes[static_cast<std::size_t>(k)].push_back(axis[k]);
        contacts.push_back(p.at);
        lines.push_back(line);
        turns.push_back(true);
    }
};

struct Score {
    int asked = 0, right = 0;
    double worst = 0;  ///< [mm] largest error of a contact point
    void add(const Score& other) {
        asked += other.asked;
        right += other.right;
    }
    [[nodiscard]] double share() const { return static_cast<double>(right) / asked; }
};

/// Searches every 23rd contact point that is at least a step-over from the turn of its pass.
Score ask(const Milled& milled, const CuttingTool& tool, bool leans) {
    const ContactPoints points(milled.surface, milled.path, leans ? milled.tool_axes : std::nullopt, tool);
    Score score;
    for (PointIndex i = 0; i < milled.path.count; i += 23) {
        const auto k = static_cast<std::size_t>(i);
        if (!milled.turns[k]) {
            const std::vector<FoundPlace> found =
                find_places(milled.path, milled.surface.passes, &points, step_over, {milled.contacts[k]});
            ++score.asked;
            if (found.empty()) continue;
            score.right += milled.lines[static_cast<std::size_t>(found.front().point)] == milled.lines[k] ? 1 : 0;
            if (const std::optional<Vec3> contact = points.at(i))
                score.worst = std::max(score.worst, (*contact - milled.contacts[k]).norm());
        }
    }
    return score;
}

SurfacePoint plane(double u, double v) { return {Vec3(u, v, 0), Vec3::UnitZ()}; }
SurfacePoint tilted(double u, double v) {
    const Vec3 across = Vec3(0.2, 1, 1.1).normalized();
    const Vec3 along = Vec3(1, 0, -0.3).normalized();
    const Vec3 normal = along.cross(across - across.dot(along) * along).normalized();
    return {u * along + v * normal.cross(along), normal};
}
/// Along the wall of a boss of radius 8, from 15° to 75° of slope.
SurfacePoint boss(double u, double v) {
    constexpr double radius = 8;
    const double slope = 0.26 + v / radius;
    const double turn = u / radius;
    const Vec3 n(std::sin(slope) * std::cos(turn), std::sin(slope) * std::sin(turn), std::cos(slope));
    return {radius * n, n};
}
/// The side of a hollow of radius 25 along x.
SurfacePoint hollow(double u, double v) {
    constexpr double radius = 25;
    const double angle = v / radius + 0.25;
    const Vec3 n(0, -std::sin(angle), std::cos(angle));
    return {Vec3(u, 0, 0) - radius * n, n};
}
/// The outside of a ring: curved both ways.
SurfacePoint ring(double u, double v) {
    constexpr double tube = 6;
    constexpr double middle = 14;
    const double turn = u / middle;
    const double slope = v / tube + 0.15;
    const Vec3 out(std::cos(turn), std::sin(turn), 0);
    const Vec3 n = std::sin(slope) * out + std::cos(slope) * Vec3::UnitZ();
    return {middle * out + tube * n, n};
}

const CuttingTool ball{ToolKind::ball, 3, 3};
const CuttingTool bull{ToolKind::bull, 4, 1};
const CuttingTool flat{ToolKind::flat, 3, 0};

TEST(ContactPoints, ThePlaceOnThePartNamesItsLine) {
    Score all;
    const std::pair<const char*, Shape> shapes[] = {
        {"plane", plane}, {"tilted", tilted}, {"boss", boss}, {"hollow", hollow}, {"ring", ring}};
    for (const auto& [name, shape] : shapes) {
        for (const CuttingTool& tool : {ball, bull, flat}) {
            const Milled milled(shape, tool, 9, 7);
            const Score score = ask(milled, tool, false);
            all.add(score);
            EXPECT_GT(score.asked, 150);
            EXPECT_GE(score.share(), 0.97) << name << ", " << to_text(tool) << ", worst " << score.worst;
        }
    }
    EXPECT_GE(all.share(), 0.99);
}

TEST(ContactPoints, AToolThatTurnsTouchesWhereItsOwnAxisSays) {
    Score all;
    // The tool leans by some 20°, ahead and to one side, varying from place to place.
    const Lean lean = [](const SurfacePoint& p, const Vec3& along) {
        const double ahead = 0.3 + 0.005 * p.at.y();
        const double aside = 0.2 + 0.05 * std::cos(0.2 * p.at.x());
        return Vec3((p.normal + ahead * along + aside * p.normal.cross(along)).normalized());
    };
    for (const Shape& shape : {Shape(tilted), Shape(boss), Shape(hollow), Shape(ring)}) {
        for (const CuttingTool& tool : {ball, bull, flat}) {
            const Milled milled(shape, tool, 6, 5, lean);
            const Score score = ask(milled, tool, true);
            all.add(score);
            EXPECT_GE(score.share(), 0.97) << to_text(tool) << ", worst " << score.worst;
        }
    }
    EXPECT_GE(all.share(), 0.99);
}

TEST(ContactPoints, AFlatBottomOnALevelFaceIsAtItsTip) {
    const Milled milled(plane, bull, 4, 4);
    const ContactPoints points(milled.surface, milled.path, std::nullopt, bull);
    for (PointIndex i = 0; i < milled.path.count; i += 13) {
        const std::optional<Vec3> contact = points.at(i);
        if (contact) { EXPECT_LT((*contact - milled.path.at(i)).norm(), 1e-9); }
    }
}

TEST(ContactPoints, WhatDoesNotCutHasNone) {
    Milled milled(tilted, ball, 4, 4);
    milled.surface.passes[0].kind = PassKind::rapid;
    const ContactPoints points(milled.surface, milled.path, std::nullopt, ball);
    EXPECT_FALSE(points.at(milled.surface.passes[0].first).has_value());
    EXPECT_TRUE(points.at(milled.surface.passes[milled.surface.passes.size() - 1].first).has_value());
}

TEST(PlaceSearch, TheNearestPassesFollowEachOther) {
    const Milled milled(tilted, ball, 6, 4);
    const ContactPoints points(milled.surface, milled.path, std::nullopt, ball);
    const PointIndex i = milled.path.count / 2 + 30;
    const std::vector<FoundPlace> found = find_places(milled.path, milled.surface.passes, &points, step_over,
                                                      {milled.contacts[static_cast<std::size_t>(i)], false, 5});
    ASSERT_EQ(found.size(), 5U);
    EXPECT_LT(found[0].distance, 0.01);
    EXPECT_NEAR(found[1].distance, step_over, 0.02);
    EXPECT_NEAR(found[2].distance, step_over, 0.02);
    EXPECT_NEAR(found[4].distance, 2 * step_over, 0.02);
}

/// A V-groove along x, whose bottom is rounded by the ball of one pass: it touches both walls and forms everything between.
constexpr double groove_bottom = 3.0;                 ///< [mm] v of that pass
constexpr double wall = 30 * std::numbers::pi / 180;  ///< slope of both walls

Vec3 centre_in_groove(double u, double v) {
    return {u, v, std::abs(v - groove_bottom) * std::tan(wall) + ball.radius / std::cos(wall)};
}

SurfacePoint groove(double u, double v) {
    const double side = v < groove_bottom ? -1 : 1;
    const Vec3 normal(0, -side * std::sin(wall), std::cos(wall));
    return {centre_in_groove(u, v) - ball.radius * normal, normal};
}

TEST(PlaceSearch, InAGrooveThePassAtItsBottomIsMeant) {
    const Milled milled(groove, ball, 6, 6);
    const ContactPoints points(milled.surface, milled.path, std::nullopt, ball);
    for (const double degrees : {-27.0, -12.0, -1.0, 4.0, 16.0, 28.0}) {
        const double angle = degrees * std::numbers::pi / 180;
        const Vec3 place =
            centre_in_groove(3.01, groove_bottom) + ball.radius * Vec3(0, std::sin(angle), -std::cos(angle));
        for (const bool from_above : {false, true}) {
            const std::vector<FoundPlace> found =
                find_places(milled.path, milled.surface.passes, &points, step_over, {place, from_above});
            ASSERT_FALSE(found.empty());
            EXPECT_NEAR(found.front().place.tip.y(), groove_bottom, 1e-9) << degrees;
            EXPECT_LT(std::abs(found.front().place.tip.x() - place.x()), spacing);
            // The result is the place itself, not an extrapolation along a normal.
            EXPECT_LT((found.front().place.position() - place).norm(), 0.6 * step_over) << degrees;
        }
    }
}

TEST(PlaceSearch, AContactThatIsCutAwayAgainIsFoundWhereItIsAskedFor) {
    // The contacts of the walls would continue below the contacts of the lowest pass.
    const Milled milled(groove, ball, 6, 6);
    const ContactPoints points(milled.surface, milled.path, std::nullopt, ball);
    const PointIndex i = milled.path.count / 3;
    const std::optional<Vec3> contact = points.at(i);
    ASSERT_TRUE(contact.has_value());
    const std::vector<FoundPlace> found =
        find_places(milled.path, milled.surface.passes, &points, step_over, {*contact});
    EXPECT_EQ(found.front().point, i);
}

TEST(PlaceSearch, FromAboveNothingIsFoundWhereNoCutterReaches) {
    const Milled milled(tilted, ball, 4, 4);
    const ContactPoints points(milled.surface, milled.path, std::nullopt, ball);
    EXPECT_TRUE(find_places(milled.path, milled.surface.passes, &points, step_over, {Vec3(40, 40, 0), true}).empty());
}

/// Under a flat tool on a level face all passes within its radius touch: the closest one is meant.
TEST(PlaceSearch, UnderAFlatBottomTheNearestPassIsMeant) {
    const Milled milled([](double u, double v) { return SurfacePoint{Vec3(u, v, 0), Vec3::UnitZ()}; }, flat, 6, 6);
    const ContactPoints points(milled.surface, milled.path, std::nullopt, flat);
    for (const double v : {1.2, 2.4, 3.6}) {
        const std::vector<FoundPlace> found =
            find_places(milled.path, milled.surface.passes, &points, step_over, {Vec3(3, v + 0.02, 0)});
        EXPECT_NEAR(found.front().place.tip.y(), v, 1e-6);
        EXPECT_LT(std::abs(found.front().place.tip.x() - 3), spacing);
    }
}

TEST(PlaceSearch, FromAboveTheTopmostLevelIsMeant) {
    // Two level faces above each other, the lower one cut last, with passes offset from the others by half a step-over.
    Columns tips;
    Passes passes;
    for (const double z : {0.0, -2.0}) {
        for (int k = 0; k < 12; ++k) {
            const auto first = static_cast<PointIndex>(tips.x.size());
            for (double x = 0; x <= 5; x += spacing)
                tips.add(Vec3(k % 2 == 0 ? x : 5 - x, k * step_over + (z < 0 ? 0.1 : 0), z));
            passes.push_back({first, static_cast<PointIndex>(tips.x.size()) - 1, PassKind::cut});
        }
    }
    const Trajectory path = tips.trajectory();
    for (const double y : {1.2, 1.25, 1.3, 1.35, 1.4}) {
        const std::vector<FoundPlace> found =
            find_places(path, passes, nullptr, step_over, {Vec3(2.02, y, 0), true, 2});
        ASSERT_EQ(found.size(), 2U);
        EXPECT_EQ(found[0].place.tip.z(), 0) << y;
    }
}

}  // namespace
}  // namespace clsurf::contact_points_test
