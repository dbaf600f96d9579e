#include "program/interpret/arc.h"
#include "program/dialects/known_dialects.h"
#include "program/interpret/dialect_rules.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace clsurf::arc_test {
namespace {

const ArcTolerance usual = fanuc_dialect.rules->arc_tolerance_in(1);

ArcWords from_to(Vec3 begin, Vec3 end, bool clockwise) {
    ArcWords words;
    words.begin = begin;
    words.end = end;
    words.clockwise = clockwise;
    return words;
}

TEST(Arc, ShortArcByRadiusHasItsCentreBesideTheChord) {
    // (0,0) → (10,0), R 10, counter-clockwise and short: the centre is to the left of the chord,
    // at height √(100 − 25).
    ArcWords words = from_to({0, 0, 0}, {10, 0, 0}, false);
    words.has_radius = true;
    words.radius = 10;
    std::string error;
    const Arc arc = resolve_arc(words, usual, error);
    ASSERT_EQ(error, "");
    EXPECT_NEAR(arc.centre.x, 5.0, 1e-12);
    EXPECT_NEAR(arc.centre.y, std::sqrt(75.0), 1e-12);
    // 60° of radius 10.
    EXPECT_NEAR(arc_length(arc, false, words.begin, words.end), 10 * std::numbers::pi / 3, 1e-9);
}

TEST(Arc, NegativeRadiusTakesTheLongWayRound) {
    ArcWords words = from_to({0, 0, 0}, {10, 0, 0}, false);
    words.has_radius = true;
    words.radius = -10;
    std::string error;
    const Arc arc = resolve_arc(words, usual, error);
    EXPECT_NEAR(arc.centre.y, -std::sqrt(75.0), 1e-12);
    EXPECT_NEAR(arc_length(arc, false, words.begin, words.end), 10 * std::numbers::pi * 5 / 3, 1e-9);
}

TEST(Arc, HelixOfThreeTurnsIsAsLongAsItsUnrolledLine) {
    ArcWords words = from_to({1, 0, 0}, {1, 0, 6}, false);
    words.centre = {0, 0, 0};
    words.turns = 3;
    std::string error;
    const Arc arc = resolve_arc(words, usual, error);
    ASSERT_EQ(error, "");
    EXPECT_NEAR(arc_length(arc, false, words.begin, words.end), std::hypot(6 * std::numbers::pi, 6.0), 1e-9);
}

TEST(Arc, NamesBothRadiiWhereTheyDiffer) {
    ArcWords words = from_to({5, 0, 0}, {0, 5.2, 0}, false);
    words.centre = {0, 0, 0};
    std::string error;
    (void)resolve_arc(words, usual, error);
    EXPECT_EQ(error, "arc radius differs: 5.0000 at the start, 5.2000 at the end");
}

/// The error of a quarter circle around 0 from one radius to another; "" if there is none.
std::string error_of_radii(double first, double second, const ArcTolerance& tolerance) {
    ArcWords words = from_to({first, 0, 0}, {0, second, 0}, false);
    words.centre = {0, 0, 0};
    std::string error;
    (void)resolve_arc(words, tolerance, error);
    return error;
}

TEST(Arc, RadiiMayDifferAsMuchAsTheControlTakes) {
    // LinuxCNC: 2·√2 hundredths of a millimetre or thousandths of an inch; up to a hundred times more within 0.1 %.
    const ArcTolerance metric = linuxcnc_dialect.rules->arc_tolerance_in(1);
    EXPECT_EQ(error_of_radii(5, 5.028, metric), "");
    EXPECT_NE(error_of_radii(5, 5.029, metric), "");
    EXPECT_EQ(error_of_radii(2802, 2804.7, metric), "");
    EXPECT_NE(error_of_radii(5000, 5002.9, metric), "");
    const ArcTolerance inches = linuxcnc_dialect.rules->arc_tolerance_in(25.4);
    EXPECT_EQ(error_of_radii(5, 5.071, inches), "");
    EXPECT_NE(error_of_radii(5, 5.073, inches), "");
    // Siemens: 0.01 mm or 0.1 %. Heidenhain: 0.016 mm.
    const ArcTolerance siemens = siemens_dialect.rules->arc_tolerance_in(1);
    EXPECT_EQ(error_of_radii(5, 5.009, siemens), "");
    EXPECT_NE(error_of_radii(5, 5.011, siemens), "");
    EXPECT_EQ(error_of_radii(100, 100.09, siemens), "");
    const ArcTolerance heidenhain = heidenhain_iso_dialect.rules->arc_tolerance_in(1);
    EXPECT_EQ(error_of_radii(100, 100.015, heidenhain), "");
    EXPECT_NE(error_of_radii(100, 100.017, heidenhain), "");
    EXPECT_EQ(error_of_radii(5, 5.029, usual), "");
    EXPECT_NE(error_of_radii(5, 5.031, usual), "");
}

TEST(Arc, SiemensMovesTheCentreSoThatOneCircleRunsThroughBothEnds) {
    ArcWords words = from_to({5, 0, 0}, {0, 5.008, 0}, false);
    words.centre = {0, 0, 0};
    std::string error;
    const Arc arc = resolve_arc(words, siemens_dialect.rules->arc_tolerance_in(1), error);
    ASSERT_EQ(error, "");
    EXPECT_NEAR(std::hypot(5 - arc.centre.x, arc.centre.y), 5, 1e-12);
    EXPECT_NEAR(std::hypot(arc.centre.x, 5.008 - arc.centre.y), 5, 1e-12);
    EXPECT_LT(std::hypot(arc.centre.x, arc.centre.y), 0.01);
}

TEST(Arc, RefusesARadiusThatCannotReach) {
    ArcWords words = from_to({0, 0, 0}, {10, 0, 0}, true);
    words.has_radius = true;
    words.radius = 4;
    std::string error;
    (void)resolve_arc(words, usual, error);
    EXPECT_EQ(error, "arc radius 4.0000 is too small: the end is 10.0000 away from the start");
}

TEST(ArcChords, ASpiralOfSeveralTurnsStaysWithinTheError) {
    // Archimedes: the radius increases from 10 to 14 over two and a half turns, and z by 5.
    Arc arc;
    arc.turns = 3;
    const Vec3 begin(10, 0, 0);
    const Vec3 end(-14, 0, 5);
    const double sweep = 5 * std::numbers::pi;
    EXPECT_NEAR(arc_sweep(arc, false, begin, end), sweep, 1e-12);
    for (const double error : {1e-2, 1e-3, 1e-4}) {
        const std::vector<Vec3> chords = arc_chords(arc, false, begin, end, error);
        EXPECT_EQ(chords.back(), end);
        double worst = 0;
        Vec3 from = begin;
        for (std::size_t k = 0; k < chords.size(); ++k) {
            const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(chords.size());
            const double radius = 10 + 4 * part;
            const Vec3 on(radius * std::cos(part * sweep), radius * std::sin(part * sweep), 5 * part);
            const Vec3 displacement = (chords[k] - from).normalized();
            const Vec3 off = on - from;
            worst = std::max(worst, (off - off.dot(displacement) * displacement).norm());
            from = chords[k];
        }
        EXPECT_LT(worst, error);
        EXPECT_GT(worst, 0.5 * error);  // and not more chords than necessary
    }
}

}  // namespace
}  // namespace clsurf::arc_test
