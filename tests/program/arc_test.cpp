#include "program/arc.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace clsurf {
namespace {

ArcWords from_to(Vec3 begin, Vec3 end, bool clockwise) {
    ArcWords words;
    words.begin = begin;
    words.end = end;
    words.clockwise = clockwise;
    return words;
}

TEST(Arc, ShortArcByRadiusHasItsCentreBesideTheChord) {
    // (0,0) → (10,0), R 10, counter-clockwise and short: the centre is left of the chord,
    // at height √(100 − 25).
    ArcWords words = from_to({0, 0, 0}, {10, 0, 0}, false);
    words.has_radius = true;
    words.radius = 10;
    std::string error;
    const Arc arc = resolve_arc(words, error);
    ASSERT_EQ(error, "");
    EXPECT_NEAR(arc.centre.x, 5.0, 1e-12);
    EXPECT_NEAR(arc.centre.y, std::sqrt(75.0), 1e-12);
    // 60° of radius 10.
    EXPECT_NEAR(arc_length(arc, false, words.begin, words.end), 10 * std::numbers::pi / 3, 1e-9);
}

TEST(Arc, NegativeRadiusTakesTheLongWay) {
    ArcWords words = from_to({0, 0, 0}, {10, 0, 0}, false);
    words.has_radius = true;
    words.radius = -10;
    std::string error;
    const Arc arc = resolve_arc(words, error);
    EXPECT_NEAR(arc.centre.y, -std::sqrt(75.0), 1e-12);
    EXPECT_NEAR(arc_length(arc, false, words.begin, words.end), 10 * std::numbers::pi * 5 / 3, 1e-9);
}

TEST(Arc, HelixOfThreeTurnsIsAsLongAsItsUnrolledLine) {
    ArcWords words = from_to({1, 0, 0}, {1, 0, 6}, false);
    words.centre = {0, 0, 0};
    words.turns = 3;
    std::string error;
    const Arc arc = resolve_arc(words, error);
    ASSERT_EQ(error, "");
    EXPECT_NEAR(arc_length(arc, false, words.begin, words.end), std::hypot(6 * std::numbers::pi, 6.0), 1e-9);
}

TEST(Arc, NamesBothRadiiWhereTheyDiffer) {
    ArcWords words = from_to({5, 0, 0}, {0, 5.2, 0}, false);
    words.centre = {0, 0, 0};
    std::string error;
    (void)resolve_arc(words, error);
    EXPECT_EQ(error, "arc radius differs: 5.0000 at the start, 5.2000 at the end");
}

TEST(Arc, RefusesARadiusThatCannotReach) {
    ArcWords words = from_to({0, 0, 0}, {10, 0, 0}, true);
    words.has_radius = true;
    words.radius = 4;
    std::string error;
    (void)resolve_arc(words, error);
    EXPECT_EQ(error, "arc radius 4.0000 is too small: the end is 10.0000 away from the start");
}

}  // namespace
}  // namespace clsurf
