#include "field/field_set.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "field/range.h"

namespace clsurf::field_set_test {
namespace {

constexpr double radius = 20;  // [mm]
constexpr double speed = 50;   // [mm/s]
constexpr double period = 0.001;

/// A circle at constant speed; feedback 5 µm inside it and 2 records late.
struct Circle {
    std::vector<double> c[3], f[3];
    Log log;
    Passes passes;
    Circle() {
        const double step = speed * period / radius;
        for (int i = 0; i < 3000; ++i) {
            c[0].push_back(radius * std::cos(step * i));
            c[1].push_back(radius * std::sin(step * i));
            c[2].push_back(1);
            f[0].push_back((radius - 0.005) * std::cos(step * (i - 2)));
            f[1].push_back((radius - 0.005) * std::sin(step * (i - 2)));
            f[2].push_back(1);
        }
        log.period = period;
        log.records = 3000;
        for (int k = 0; k < 3; ++k) {
            log.channels.push_back({std::string("cmd.") + "xyz"[k], "mm", view_of(c[k])});
            log.channels.push_back({std::string("fb.") + "xyz"[k], "mm", view_of(f[k])});
        }
        passes.push_back({0, 2999, PassKind::cut});
    }
    Field get(const char* name) {
        const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
        return FieldSet(log, path, passes).get(name);
    }
};

/// A field of one cut pass along these commanded x, y and z [mm].
Field field_along(const std::vector<double> (&commanded)[3], const char* name) {
    const auto count = std::ssize(commanded[0]);
    Log log;
    log.period = period;
    log.records = count;
    for (std::size_t k = 0; k < 3; ++k)
        log.channels.push_back({std::string("cmd.") + "xyz"[k], "mm", view_of(commanded[k])});
    Passes passes;
    passes.push_back({0, count - 1, PassKind::cut});
    return FieldSet(log, reconstruct(log, Role::commanded, Vec3::Zero()), passes).get(name);
}

TEST(FieldSet, ShowsNoMotionBeforeTheToolStarts) {
    // A rest, a start with 800 mm/s², 40 mm/s, and a symmetric stop. Positions of 0.1 µm.
    constexpr double acceleration = 800, top = 40, rest = 0.2, ramp = top / acceleration, run = 0.3;
    std::vector<double> columns[3];
    double x = 0, v = 0;
    std::vector<double> speeds;
    for (int i = 0; i < 1000; ++i) {
        const double t = i * period - rest;
        const double wanted = std::clamp(acceleration * std::min(t, 2 * ramp + run - t), 0.0, top);
        x += 0.5 * (v + wanted) * period;
        v = wanted;
        speeds.push_back(v);
        columns[0].push_back(std::round(x * 1e4) / 1e4);
        columns[1].push_back(0);
        columns[2].push_back(0);
    }
    const Field speed_there = field_along(columns, "speed");
    for (std::size_t i = 0; i < 1000; ++i) {
        if (speeds[i] == 0 && i != 200 && i != 600) { EXPECT_NEAR(speed_there.values[i], 0, 1e-9) << i; }
        EXPECT_NEAR(speed_there.values[i], speeds[i], 2) << i;  // the corners of the ramps are rounded
    }
}

TEST(FieldSet, KnowsTheSpeedAndAccelerationOfACircle) {
    Circle circle;
    const Field v = circle.get("speed");
    const Field a = circle.get("acceleration");
    const Field n = circle.get("normal_acceleration");
    const Field t = circle.get("tangential_acceleration");
    const Field k = circle.get("curvature");
    const Field j = circle.get("jerk");
    for (std::size_t i = 50; i < 2950; i += 100) {
        EXPECT_NEAR(v.values[i], speed, 0.01);
        EXPECT_NEAR(a.values[i], speed * speed / radius, 0.05);  // 125 mm/s²
        EXPECT_NEAR(n.values[i], speed * speed / radius, 0.05);
        EXPECT_NEAR(t.values[i], 0, 0.01);
        EXPECT_NEAR(k.values[i], 1 / radius, 1e-4);
        EXPECT_NEAR(j.values[i], speed * speed * speed / (radius * radius), 0.5);  // 312.5 mm/s³
    }
}

TEST(FieldSet, CurvatureIsThatOfThePathWhereTheToolHardlyMoves) {
    // The circle from rest to 50 mm/s and back to rest, at positions of 0.1 µm: 0.05 1/mm all along it.
    std::vector<double> columns[3];
    constexpr PointIndex count = 2000;
    double way = 0;
    for (PointIndex i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / (count - 1);
        way += speed * std::sin(share * M_PI) * std::sin(share * M_PI) * period;
        columns[0].push_back(std::round(radius * std::cos(way / radius) * 1e4) / 1e4);
        columns[1].push_back(std::round(radius * std::sin(way / radius) * 1e4) / 1e4);
        columns[2].push_back(0);
    }
    const Field k = field_along(columns, "curvature");
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_NEAR(k.values[i], 1 / radius, 0.4 / radius) << i;  // its standard error is a tenth
}

TEST(FieldSet, CurvatureLeavesOutTheCornersBetweenPasses) {
    // Along X, a corner of 90 deg with a radius of 0.02 mm, along Y; an arc of 1 mm is not a corner.
    for (const double round : {0.02, 1.0}) {
        std::vector<double> columns[3];
        const double quarter = 0.5 * M_PI * round;
        constexpr double step = 0.004;
        for (double s = -3; s < quarter + 3; s += step) {
            const double angle = std::clamp(s / round, 0.0, 0.5 * M_PI);
            columns[0].push_back(std::min(s, 0.0) + round * std::sin(angle));
            columns[1].push_back(round * (1 - std::cos(angle)) + std::max(s - quarter, 0.0));
            columns[2].push_back(0);
        }
        const Field k = field_along(columns, "curvature");
        float most = 0;
        std::size_t without = 0;
        for (const float value : k.values) {
            if (std::isnan(value))
                ++without;
            else
                most = std::max(most, value);
        }
        EXPECT_EQ(without > 0, round < 0.1);
        EXPECT_NEAR(most, round < 0.1 ? 0 : 1 / round, 0.1) << round;
    }
}

TEST(FieldSet, TellsLagFromContourError) {
    Circle circle;
    const Field lag = circle.get("following_error");
    const Field contour = circle.get("contour_error");
    // 2 records at 50 mm/s are 0.1 mm along the path; across it the error is 5 µm.
    for (std::size_t i = 100; i < 2900; i += 100) {
        EXPECT_NEAR(lag.values[i], 0.1, 0.001);
        EXPECT_NEAR(contour.values[i], 0.005, 0.0002);
    }
}

TEST(FieldSet, SuggestsTheNearestNameAndNamesMissingRoles) {
    Circle circle;
    try {
        (void)circle.get("acelleration");
        FAIL();
    } catch (const UsageError& error) { EXPECT_EQ(error.hint(), "did you mean 'acceleration'?"); }
    circle.log.channels.erase(circle.log.channels.begin() + 1);  // fb.x
    EXPECT_THROW((void)circle.get("following_error"), UsageError);
}

TEST(Range, LeavesOutRapidsAndOutliers) {
    Field field;
    field.values.resize(10'000);
    for (std::size_t i = 0; i < 10'000; ++i) field.values[i] = static_cast<float>(i < 1000 ? 1e6 : i % 100);
    Passes passes;
    passes.push_back({0, 999, PassKind::rapid});
    passes.push_back({1000, 9999, PassKind::cut});
    const ShownRange range = find_range(field, passes, {});
    EXPECT_NEAR(range.low, 1, 1);
    EXPECT_NEAR(range.high, 98, 1);
    EXPECT_EQ(range.lowest, 0);
    EXPECT_EQ(range.highest, 99);
}

TEST(Range, IsThatOfTheShownPoints) {
    Field field;
    field.values.resize(10'000);
    for (std::size_t i = 0; i < 10'000; ++i) field.values[i] = static_cast<float>(i);
    field.values[2500] = std::numeric_limits<float>::quiet_NaN();
    Passes passes;
    passes.push_back({0, 9999, PassKind::cut});
    const auto shown = [](PointIndex i) { return i >= 2000 && i < 3000; };
    const ShownRange range = find_range(field, passes, {}, shown);
    EXPECT_NEAR(range.low, 2010, 1);
    EXPECT_NEAR(range.high, 2990, 1);
    EXPECT_EQ(range.lowest, 2000);
    EXPECT_EQ(range.highest, 2999);
    EXPECT_NE(range.note.find("1000 shown cutting points"), std::string::npos) << range.note;
    const RangeRule fixed{RangeRule::Kind::fixed, -1, 1};
    EXPECT_EQ(find_range(field, passes, fixed, shown).high, 1);
    EXPECT_EQ(find_range(field, passes, fixed, shown).highest, 2999);
    EXPECT_THROW((void)find_range(field, passes, {}, [](PointIndex) { return false; }), UsageError);
}

TEST(FieldSet, ShowsChannelsInTheUnitsOfTheLog) {
    Circle circle;
    for (const char* unit : {"bar", "Nm", "rpm", "deg/min", "mm/s²", ""}) {
        Channel channel = circle.log.channels.front();
        channel.name = std::string("of ") + unit;
        channel.unit = unit;
        circle.log.channels.push_back(channel);
        const Field field = circle.get(channel.name.c_str());
        EXPECT_EQ(field.info.unit.name, unit);
        EXPECT_EQ(field.info.unit.per_inside, 1);
    }
}

}  // namespace
}  // namespace clsurf::field_set_test
