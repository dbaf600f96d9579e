#include "compare/defect_match.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/field_difference.h"

namespace clsurf::defect_match_test {
namespace {

constexpr double step_over = 0.5;  // [mm]
constexpr PointIndex per_pass = 200;

/// Level passes of 20 mm along x, `step_over` apart; `first`: y of the first one [mm].
Positions passes(int count, double first = 0, Vec3 origin = Vec3::Zero()) {
    Positions positions;
    positions.origin = origin;
    for (int pass = 0; pass < count; ++pass) {
        for (PointIndex i = 0; i < per_pass; ++i) {
            positions.x.push_back(static_cast<float>(0.1 * static_cast<double>(i) - origin.x()));
            positions.y.push_back(static_cast<float>(first + step_over * pass - origin.y()));
            positions.z.push_back(static_cast<float>(-origin.z()));
        }
    }
    return positions;
}

/// On a pass, from point to point of it.
Defect defect_on(int pass, PointIndex first, PointIndex last, Quantity quantity = Quantity::speed) {
    Defect defect;
    defect.quantity = quantity;
    DefectSection run;
    run.pass = pass + 1;
    run.points = {pass * per_pass + first, pass * per_pass + last};
    defect.sections.push_back(run);
    return defect;
}

DefectMatch match(const std::vector<Defect>& before, const std::vector<Defect>& after,
                  const Positions& positions_before = passes(20), const Positions& positions_after = passes(20)) {
    return match_defects({&before, &positions_before, step_over}, {&after, &positions_after, step_over});
}

TEST(DefectMatch, OfARunWithItselfRemainsWhole) {
    const std::vector<Defect> defects{defect_on(3, 50, 80), defect_on(4, 50, 80), defect_on(9, 10, 11),
                                      defect_on(9, 10, 11, Quantity::normal_deviation)};
    const DefectMatch found = match(defects, defects);
    for (std::size_t i = 0; i < defects.size(); ++i) EXPECT_EQ(found.before_of[i], i);
    EXPECT_TRUE(found.gone.empty());
    EXPECT_EQ(found.remaining(), 4U);
    EXPECT_EQ(found.fresh(), 0U);
}

TEST(DefectMatch, TellsGoneNewAndRemaining) {
    const DefectMatch found =
        match({defect_on(3, 50, 80), defect_on(8, 50, 80)}, {defect_on(12, 50, 80), defect_on(8, 60, 90)});
    EXPECT_EQ(found.before_of[0], std::nullopt);
    EXPECT_EQ(found.before_of[1], 1U);
    EXPECT_EQ(found.gone, std::vector<std::size_t>{0});
}

TEST(DefectMatch, TheAdjacentPassIsAnotherMark) {
    const DefectMatch found = match({defect_on(3, 50, 80)}, {defect_on(4, 50, 80)});
    EXPECT_EQ(found.fresh(), 1U);
    EXPECT_EQ(found.gone.size(), 1U);
}

TEST(DefectMatch, NeedsAQuarterOfTheShorterOne) {
    EXPECT_EQ(match({defect_on(3, 0, 100)}, {defect_on(3, 60, 160)}).remaining(), 1U);
    EXPECT_EQ(match({defect_on(3, 0, 100)}, {defect_on(3, 90, 190)}).remaining(), 0U);
    EXPECT_EQ(match({defect_on(3, 0, 190)}, {defect_on(3, 100, 104)}).remaining(), 1U);
}

TEST(DefectMatch, KindsDoNotMix) {
    EXPECT_EQ(match({defect_on(3, 50, 80)}, {defect_on(3, 50, 80, Quantity::relief)}).remaining(), 0U);
    EXPECT_EQ(match({defect_on(3, 50, 80)}, {defect_on(3, 50, 80, Quantity::acceleration)}).remaining(), 1U);
    Defect whole = defect_on(3, 50, 80, Quantity::normal_deviation);
    whole.systematic = true;
    EXPECT_EQ(match({whole}, {defect_on(3, 50, 80, Quantity::normal_deviation)}).remaining(), 0U);
    EXPECT_EQ(match({whole}, {whole}).remaining(), 1U);
}

TEST(DefectMatch, OneThatBreaksRemainsInEachPart) {
    const DefectMatch found = match({defect_on(3, 20, 160)}, {defect_on(3, 20, 60), defect_on(3, 120, 160)});
    EXPECT_EQ(found.remaining(), 2U);
    EXPECT_TRUE(found.gone.empty());
}

TEST(DefectMatch, PlacesDecideNotNumbers) {
    // The second run begins one pass later, and counts from another origin.
    const DefectMatch found =
        match({defect_on(4, 50, 80)}, {defect_on(3, 50, 80)}, passes(20), passes(20, step_over, Vec3(100, -30, 7)));
    EXPECT_EQ(found.remaining(), 1U);
}

TEST(DefectMatch, NothingMatchesNothing) {
    EXPECT_EQ(match({}, {}).remaining(), 0U);
    EXPECT_EQ(match({defect_on(1, 0, 9)}, {}).gone.size(), 1U);
}

TEST(FieldDifference, IsTakenWhereTheRunsMeet) {
    Field before, after;
    after.info = {"speed", "Path speed", {}, FieldScale::sequential, {}};
    for (const float value : {10.0F, 20.0F, 40.0F}) before.values.push_back(value);
    for (const float value : {1.0F, 2.0F, 3.0F}) after.values.push_back(value);
    RunAlignment alignment;
    for (const PathLocation place : {PathLocation{0, 0.5F}, PathLocation{-1, 0}, PathLocation{2, 0}})
        alignment.locations.push_back(place);
    const Field difference = difference_of(after, before, alignment);
    EXPECT_FLOAT_EQ(difference.values[0], 1 - 15);
    EXPECT_TRUE(std::isnan(difference.values[1]));
    EXPECT_FLOAT_EQ(difference.values[2], 3 - 40);
    EXPECT_EQ(difference.info.scale, FieldScale::diverging);
    EXPECT_EQ(difference.info.label, "Path speed, after minus before");
}

}  // namespace
}  // namespace clsurf::defect_match_test
