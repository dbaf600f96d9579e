#include "viz/field_classes.h"

#include <array>
#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace clsurf::viz::field_classes_test {
namespace {

FieldInfo limits() {
    FieldInfo info;
    info.classes = {{0, "at rest"}, {1, "feed", true}, {4, "jerk"}, {5, "corner"}};
    return info;
}

Column<float> column(std::initializer_list<float> values) {
    Column<float> made;
    for (const float value : values) made.push_back(value);
    return made;
}

Passes passes_of(std::initializer_list<Pass> passes) {
    Passes made;
    for (const Pass& pass : passes) made.push_back(pass);
    return made;
}

/// All points cut.
Passes one_pass(std::size_t points) { return passes_of({{0, static_cast<PointIndex>(points) - 1, PassKind::cut}}); }

TEST(FieldClasses, SharesAreThoseOfCuttingPoints) {
    const Column<float> values = column({0, 0, 0, 1, 1, 4, 4, 4, 4, 5});
    const Passes passes = passes_of({{0, 2, PassKind::rapid}, {3, 9, PassKind::cut}});
    const FieldClasses classes(limits(), values, passes);
    ASSERT_EQ(classes.shown().size(), 3u) << "what does not occur is not in the legend";
    EXPECT_EQ(classes.shown()[0].name, "jerk");
    EXPECT_NEAR(classes.shown()[0].share, 4.0 / 7, 1e-12);
    EXPECT_EQ(classes.shown()[1].name, "feed");
    EXPECT_EQ(classes.shown()[2].name, "corner");
}

TEST(FieldClasses, AKnownClassHasTheSameColourInEveryPicture) {
    const Passes passes = one_pass(4);
    const FieldClasses some(limits(), column({1, 1, 1, 4}), passes);
    const FieldClasses others(limits(), column({5, 5, 4, 4}), passes);
    EXPECT_EQ(some.place_of(4), others.place_of(4));
    EXPECT_EQ(some.scale().colour(some.place_of(4)), others.scale().colour(others.place_of(4)));
    EXPECT_NE(some.scale().colour(some.place_of(4)), some.scale().colour(some.place_of(5)));
}

TEST(FieldClasses, TheLegendHasTheColourOfTheMap) {
    const Column<float> values = column({0, 1, 4, 5, 4, 1});
    const FieldClasses classes(limits(), values, one_pass(values.size()));
    for (const FieldClass& known : limits().classes) {
        for (const ShownClass& shown : classes.shown()) {
            if (shown.name == known.name) {
                EXPECT_EQ(classes.scale().colour(classes.place_of(known.value)), shown.rgb) << known.name;
            }
        }
    }
}

TEST(FieldClasses, OfManyTheLargestHaveNames) {
    FieldInfo lines;
    lines.class_word = "line";
    Column<float> values;
    for (int line = 1; line <= 30; ++line) {
        for (int k = 0; k < line; ++k) values.push_back(static_cast<float>(line));
    }
    const FieldClasses classes(lines, values, one_pass(values.size()));
    ASSERT_EQ(classes.shown().size(), FieldClasses::most_named + 1);
    EXPECT_EQ(classes.shown().front().name, "line 30");
    EXPECT_EQ(classes.shown().back().name, "21 others");
    double all = 0;
    for (const ShownClass& shown : classes.shown()) all += shown.share;
    EXPECT_NEAR(all, 1, 1e-12);
    EXPECT_NE(classes.place_of(1), classes.place_of(2)) << "adjacent ones are told apart";
}

TEST(FieldClasses, HasNoPlaceForWhatIsNoClass) {
    const FieldClasses classes(limits(), column({1, 4}), one_pass(2));
    EXPECT_NE(classes.place_of(3), classes.place_of(3));
    EXPECT_NE(classes.place_of(std::numeric_limits<float>::quiet_NaN()), classes.place_of(1));
}

/// One triangle with corners of three classes.
Detail three_corners() {
    Detail detail;
    for (const float v : {0.F, 0.F, 0.F, 6.F, 0.F, 0.F, 0.F, 6.F, 0.F}) detail.geometry.xyz.push_back(v);
    for (const std::uint32_t v : {0u, 1u, 2u}) {
        detail.geometry.triangles.push_back(v);
        detail.points.push_back(static_cast<PointIndex>(v));
        detail.values.push_back(0);
    }
    return detail;
}

TEST(DivideByClass, GivesEachCornerAThirdOfItsTriangle) {
    const Column<float> values = column({1, 4, 5});
    const FieldClasses classes(limits(), values, one_pass(values.size()));
    Detail detail = three_corners();
    divide_by_class(detail, values, classes);
    const Geometry& g = detail.geometry;
    std::map<float, double> area;
    for (std::size_t i = 0; i < g.triangles.size(); i += 3) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t v = 3 * static_cast<std::size_t>(g.triangles[i + k]);
            p[k] = Vec3(g.xyz[v], g.xyz[v + 1], g.xyz[v + 2]);
            EXPECT_EQ(detail.values[g.triangles[i + k]], detail.values[g.triangles[i]]) << "of one class";
        }
        const double twice = (p[1] - p[0]).cross(p[2] - p[0]).z();
        EXPECT_GT(twice, 0) << "turned as the whole one";
        area[detail.values[g.triangles[i]]] += 0.5 * twice;
    }
    ASSERT_EQ(area.size(), 3u);
    for (const auto& [value, size] : area) EXPECT_NEAR(size, 6.0, 1e-6);
    EXPECT_EQ(detail.points.size(), g.xyz.size() / 3);
}

TEST(DivideByClass, LeavesCellsOfOneClassWhole) {
    const Column<float> values = column({4, 4, 4});
    const FieldClasses classes(limits(), values, one_pass(values.size()));
    Detail detail = three_corners();
    divide_by_class(detail, values, classes);
    EXPECT_EQ(detail.geometry.triangles.size(), 3u);
}

}  // namespace
}  // namespace clsurf::viz::field_classes_test
