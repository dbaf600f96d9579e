// Splines: which curve each dialect's words make, where they stand, and what is refused. Expected values come from the
// definition of each curve, worked out here, not from the code that reads them.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "program/motion_rows.h"

namespace clsurf::curves_test {
namespace {

Vec3 at(const Program& program, std::size_t curve, double t) { return program.motions.curves.at(curve).span->at(t); }

void expect_at(const Program& program, std::size_t curve, double t, const Vec3& expected) {
    EXPECT_LE((at(program, curve, t) - expected).norm(), 5e-10) << "curve " << curve << " at " << t;
}

/// The program with an error: its line and a part of the message.
void expect_refused(const std::string& text, const char* dialect, const std::string& begin, const std::string& part) {
    const std::string error = error_of(text, dialect);
    EXPECT_TRUE(error.starts_with("test.nc:" + begin)) << error;
    EXPECT_NE(error.find(part), std::string::npos) << error;
}

std::string file(const std::string& name) {
    std::ifstream stream(std::string(SAMPLE_DATA) + "/programs/" + name);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Curves, ABlockIsOneMotionThatOwnsItsCurve) {
    const Program p = parse("G21\nF60\nG5 X3 Y0 I1 J2 P-1 Q2\nX6 Y0 P-1 Q2\nG5.1 X8 I1 J-2\n", "linuxcnc");
    EXPECT_EQ(motions(p), (Rows{"spline 3 0 0", "spline 6 0 0", "spline 8 0 0"}));
    ASSERT_EQ(p.motions.curves.size(), 3U);
    // Bézier points (0,0) (1,2) (2,2) (3,0); then the direction goes on: (3,0) (4,-2) (5,2) (6,0); then (6,0) (7,-2) (8,0).
    expect_at(p, 0, 0.5, {1.5, 1.5, 0});
    expect_at(p, 1, 0.25, {3 + 0.75, (3 * 0.5625 * 0.25 * -2) + (3 * 0.75 * 0.0625 * 2), 0});
    expect_at(p, 2, 0.5, {7, -1, 0});
    EXPECT_EQ(p.motions.line[1], 4U);
    EXPECT_EQ(p.motions.curve_of(1)->motion, 1);
}

TEST(Curves, ClampedEvenKnotsOfLinuxCnc) {
    // Order 3 over four points: two parabolas that meet in the middle of the second leg.
    const Program p = parse("F60\nG5.2 P1 L3\nX2 Y4 P1\nX6 Y4 P1\nX8 Y0 P1\nG5.3\nG1 X9\n", "linuxcnc");
    EXPECT_EQ(motions(p), (Rows{"spline 4 4 0", "spline 8 0 0", "feed 9 0 0"}));
    expect_at(p, 0, 0.5, {(2 * 2 + 4) / 4.0, (2 * 4 + 4) / 4.0, 0});
    expect_at(p, 1, 0.5, {(4 + 2 * 6 + 8) / 4.0, (4 + 2 * 4) / 4.0, 0});
    // They stand in the block that makes them, as its kernel reports them.
    EXPECT_EQ(p.motions.line[0], 6U);
}

TEST(Curves, KnotsAndWeightsOfFanuc) {
    // A quarter of a circle: order 3, weights 1, √½, 1.
    const std::string text =
        "G21 G90\nG0 X10 Y0 Z0\nG06.2 P3 K0 X10 Y0 R1 F600\nK0 X10 Y10 R0.70710678118654752\nK0 X0 Y10 R1\nK1\nK1\nK1\nG01 X-5\n";
    const Program p = parse(text, "fanuc");
    EXPECT_EQ(motions(p), (Rows{"rapid 10 0 0", "spline 0 10 0", "feed -5 10 0"}));
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(p, 0, k / 10.0).norm(), 10, 1e-12);
    EXPECT_EQ(p.motions.line[1], 5U);  // the last point that shapes the span
    EXPECT_FLOAT_EQ(p.motions.feed[1], 10);
    // The first block without a point or a knot: where the tool stands, and the knot of the second.
    const Program short_form = parse(
        "G21 G90\nG0 X10 Y0 Z0\nG06.2 P3 K0 F600\nK0 X10 Y10 R0.70710678118654752\nK0 X0 Y10\nK1\nK1\nK1\n", "fanuc");
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(short_form, 0, k / 10.0).norm(), 10, 1e-12);
    // Uneven knots: two parabolas of lengths 1 and 3 meet at (3·P1 + 1·P2)/4.
    const Program uneven =
        parse("G0 X0 Y0 Z0\nG6.2 P3 K0 X0 Y0 F60\nK0 X0 Y4\nK0 X4 Y4\nK1 X4 Y0\nK4\nK4\nK4\n", "fanuc");
    expect_at(uneven, 0, 1, {1, 4, 0});
    EXPECT_EQ(uneven.motions.line[1], 4U);
    EXPECT_EQ(uneven.motions.line[2], 5U);
}

TEST(Curves, KnottedSplinesRefuseWhatTheControlRefuses) {
    expect_refused("G0 X0 Y0 Z0\nG6.2 P3 K0 X1 Y0 F60\n", "fanuc", "2:", "begins where the tool stands");
    const std::string begin = "G0 X0 Y0 Z0\nG6.2 P3 K0 X0 Y0 F60\nK0 X1 Y1\nK0 X2 Y0\n";
    expect_refused(begin + "K1\nK1\nG1 X5\n", "fanuc", "7:", "ends with 3 blocks of K alone, here are 2");
    expect_refused(begin + "K1\nK1\n", "fanuc", "", "ends with 3 blocks of K alone, here are 2");
    expect_refused(begin + "X3 Y3\n", "fanuc", "5:", "needs its knot (K)");
    expect_refused(begin + "K-1\nK1\nK1\n", "fanuc", "7:", "may not fall");
    expect_refused(begin + "K1\nK1\nK2\n", "fanuc", "7:", "the last 3");
    expect_refused(begin + "K1\nK1 A5\nK1\n", "fanuc", "6:", "rotary axes");
    expect_refused("G0 X0 Y0 Z0\nG6.2 P1 K0 X0 Y0 F60\n", "fanuc", "2:", "order of a spline (P)");
    expect_refused("G0 X0 Y0 Z0\nG6.2 P3 K0 X0 Y0 F60\nK0 X1 R0\n", "fanuc", "3:", "a weight (R)");
}

TEST(Curves, AnOpenSplineOfLinuxCncIsAnError) {
    expect_refused("F60\nG5.2 X1 Y1 P2\nX2 Y2 P1\nG1 X5\n", "linuxcnc", "4:", "not closed by G5.3");
    expect_refused("F60\nG5.2 X1 Y1 P2\nX2 Y2 P1\nM2\n", "linuxcnc", "", "not closed by G5.3");
    expect_refused("F60\nG5.3\n", "linuxcnc", "2:", "G5.3 without G5.2");
}

TEST(Curves, PolynomialsOfSinumerik) {
    // x(p) = 10 + a1 p − 42 p² + 15.6666666667 p³ with x(1) = 13.6666666667: a1 = 30.
    const Program p = parse(
        "G71 G90\nG0 X10 Y0 Z0\nG1 F1000\nPOLY\nPO[X]=(13.6666666667,-42,15.6666666667) PO[Y]=(13,-78,31) PO[]=(1,0,0)\n"
        "PO[X]=(16,2) Z4 PL=2\nG1 X0\n",
        "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 10 0 0", "spline 13.6667 13 0", "spline 16 13 4", "feed 0 13 4"}));
    expect_at(p, 0, 0.5, {10 + 15 - 10.5 + 15.6666666667 / 8, 30 - 19.5 + 31.0 / 8, 0});
    // Over p from 0 to 2: x = 13.6666666667 + a1 p + 2 p², 2 a1 = 16 − 13.6666666667 − 8; z is even.
    const double slope = (16 - 13.6666666667 - 8) / 2;
    expect_at(p, 1, 0.5, {13.6666666667 + slope + 2, 13, 2});
}

TEST(Curves, ADenominatorMakesACircle) {
    // x = (1 − p²)/(1 + p²), y = 2 p/(1 + p²) times 10; z rises evenly beside it.
    const Program p =
        parse("G71 G90\nG0 X10 Y0 Z0\nG1 F1000\nPOLY PO[X]=(0,-10) PO[Y]=(10,0) PO[]=(2,1) Z3\nG1 X5\n", "siemens");
    for (int k = 0; k <= 10; ++k) {
        const Vec3 q = at(p, 0, k / 10.0);
        EXPECT_NEAR(q.head<2>().norm(), 10, 1e-12);
        EXPECT_NEAR(q.z(), 0.3 * k, 1e-12);
    }
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nPOLY PO[X]=(5,1) PO[]=(-1)\n", "siemens", "4:", "greater than 0");
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nPOLY PO[A]=(5,1)\n", "siemens", "4:", "X, Y and Z are supported");
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 PO[X]=(5,1) F100\n", "siemens", "3:", "POLY is not in force");
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 POLY PO[X]=(5,1) F100\n", "siemens", "3:4:", "POLY and G1 in one block");
}

TEST(Curves, TheExampleOfTheManualIsACircle) {
    // SINUMERIK, 5-axis machining, reference section: from the zero to (1/4, √3/4), about (1/4, √3/12). Its numbers have
    // three decimals.
    const Program p = parse(
        "G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nPOLY PO[X]=(0.25,0.5,0) PO[Y]=(0.433,0,0) PO[]=(1,1,0)\nG1 X5\n", "siemens");
    for (int k = 0; k <= 10; ++k)
        EXPECT_NEAR((at(p, 0, k / 10.0) - Vec3(0.25, std::sqrt(3.0) / 12, 0)).norm(), std::sqrt(3.0) / 6, 5e-5);
}

TEST(Curves, SplinesThroughPointsEndWithTheMotionsBesideThem) {
    // BTAN and ETAN are the default: the direction of the blocks beside the spline.
    const std::string points = "CSPLINE X20 Y0\nX30 Y10\nX30 Y20\n";
    const Program p = parse("G71 G90\nG0 X0 Y0 Z0\nG1 X10 F1000\n" + points + "G1 X30 Y30\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 10 0 0", "spline 20 0 0", "spline 30 10 0", "spline 30 20 0",
                                "feed 30 30 0"}));
    EXPECT_LE((p.motions.curves[0].span->tangent(0) - Vec3(1, 0, 0)).norm(), 1e-12);
    EXPECT_LE((p.motions.curves[2].span->tangent(1) - Vec3(0, 1, 0)).norm(), 1e-12);
    EXPECT_EQ(p.motions.line[2], 4U);
    EXPECT_EQ(p.motions.line[4], 6U);
    // Before an arc the tangent is that of the arc.
    const Program arc = parse("G71 G90\nG0 X0 Y0 Z0\nG1 X10 F1000\n" + points + "G3 X20 Y30 I-10 J0\n", "siemens");
    EXPECT_LE((arc.motions.curves[2].span->tangent(1) - Vec3(0, 1, 0)).norm(), 1e-12);
    EXPECT_EQ(arc.motions.arcs.at(0).motion, 5);
    // Without curvature at both ends.
    const Program natural = parse("G71 G90\nG0 X0 Y0 Z0\nG1 X10 F1000\nBNAT ENAT " + points + "M30\n", "siemens");
    EXPECT_LE(natural.motions.curves[0].span->jet(0).second.norm(), 1e-9);
    EXPECT_LE(natural.motions.curves[2].span->jet(1).second.norm(), 1e-9);
    // Events keep their place.
    const Program events =
        parse("G71 G90\nG0 X0 Y0 Z0\nG1 X10 F1000\nCSPLINE X20 Y0\nM8\nX30 Y10\nX30 Y20\nM9\nG1 X30 Y30\n", "siemens");
    std::vector<std::int64_t> places;
    for (const ProgramEvent& event : events.events) {
        if (event.name == "coolant") places.push_back(event.motion);
    }
    EXPECT_EQ(places, (std::vector<std::int64_t>{3, 5}));
}

TEST(Curves, ControlPointsOfBspline) {
    // Degree 2, weights: the quarter circle; PL of the i-th block is the i-th span.
    const Program circle = parse(
        "G71 G90\nG0 X10 Y0 Z0\nG1 F1000\nBSPLINE X10 Y10 PW=0.70710678118654752 SD=2\nX0 Y10\nG1 X-5\n", "siemens");
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(circle, 0, k / 10.0).norm(), 10, 1e-12);
    const Program uneven =
        parse("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE SD=2 X0 Y4 PL=1\nX4 Y4 PL=3\nX4 Y0 PL=0\nG1 X9\n", "siemens");
    expect_at(uneven, 0, 1, {1, 4, 0});
    // Writers that give each leg its interval begin and end with 0.
    const Program by_leg = parse(
        "G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE X0 Y4 PL=0\nX4 Y4 PL=1\nX4 Y0 PL=3\nX8 Y0 PL=0\nG1 X9\n", "siemens");
    ASSERT_EQ(by_leg.motions.curves.size(), 2U);
    // Knots 0 0 0 0 1 4 4 4 4: the joint is the blossom at (1, 1, 1).
    expect_at(by_leg, 0, 1, {0.75 * 1 + 0.25 * 4, 0.75 * 4 + 0.25 * 3, 0});
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE X1 PL=1\nX2\nX3 Y1\nX4\nX5\nG1 X9\n", "siemens",
                   "9:", "PL is missing");
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE X1 A5\n", "siemens", "4:", "rotary axes");
}

// G1 without a motion ends a spline: the next point begins another one, of one span each, where the tool stands.
TEST(Curves, G1BetweenSplinesPartsThem) {
    const Program two = parse(
        "G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE SD=3 X1 Y2 PL=3\nX2 Y2\nX3 Y0\nG1\nBSPLINE SD=3 X4 Y-2 PL=2\nX5 Y-2\n"
        "X6 Y0\nG1\nX9\nM30\n",
        "siemens");
    ASSERT_EQ(two.motions.curves.size(), 2U);
    // A cubic Bézier curve at one half: (P0 + 3 P1 + 3 P2 + P3) / 8.
    expect_at(two, 0, 0.5, {1.5, 1.5, 0});
    expect_at(two, 0, 1, {3, 0, 0});
    expect_at(two, 1, 0.5, {4.5, -1.5, 0});
    expect_at(two, 1, 1, {6, 0, 0});
    // The same of points that a spline goes through: two lines are two splines, with a corner where they meet.
    const Program points =
        parse("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nASPLINE X1 Y1\nG1\nASPLINE X2 Y0\nG1\nM30\n", "siemens");
    ASSERT_EQ(points.motions.curves.size(), 2U);
}

TEST(Curves, FramesTakeCurvesAlong) {
    const Program p =
        parse("G71 G90\nTRANS X100\nAROT Z90\nG0 X0 Y0 Z0\nG1 F1000\nPOLY PO[X]=(4,2) Y2\nG1 X0\n", "siemens");
    // In programmed coordinates x = 2 p + 2 p², y = 2 p; turned by 90° and moved.
    expect_at(p, 0, 0.5, {100 - 1, 1.5, 0});
    const Program inch = parse("G70 G90\nG0 X0 Y0 Z0\nG1 F10\nPOLY PO[X]=(4,2) Y2\nG1 X0\n", "siemens");
    expect_at(inch, 0, 0.5, {1.5 * 25.4, 25.4, 0});
}

TEST(Curves, SplOfKlartextRunsFromOneToZero) {
    const std::string head = "0 BEGIN PGM A MM\n1 L X+28.338 Y+19.385 Z-0.5 FMAX\n";
    const std::string block =
        "2 SPL X24.875 Y15.924 Z-0.5\n  K3X-4.688E-002 K2X2.459E-002 K1X3.486E+000\n"
        "  K3Y-4.563E-002 K2Y2.155E-002 K1Y3.486E+000\n  K3Z0.000E+000 K2Z0.000E+000 K1Z0.000E+000 F10000\n";
    const Program p = parse(head + block + "3 L X0\n4 END PGM A MM\n", "klartext");
    EXPECT_EQ(motions(p), (Rows{"rapid 28.338 19.385 -0.5", "spline 24.875 15.924 -0.5", "feed 0 15.924 -0.5"}));
    EXPECT_EQ(p.motions.line[1], 3U);
    // Half way, t = ½; the begin is the tool's, 0.71 µm and 1.08 µm aside, of which an eighth is left there.
    const double x =
        24.875 + (-4.688e-2 / 8 + 2.459e-2 / 4 + 3.486 / 2) - (24.875 - 4.688e-2 + 2.459e-2 + 3.486 - 28.338) / 8;
    EXPECT_NEAR(at(p, 0, 0.5).x(), x, 1e-12);
    expect_refused("0 BEGIN PGM A MM\n1 L X+28 Y+19.385 Z-0.5 FMAX\n" + block, "klartext",
                   "3:", "the tool stands at 28.0000");
    expect_refused(head + "2 SPL X24.875 K3X1 K2X1\n", "klartext", "3:", "K1X");
    expect_refused(head + "2 SPL X24 K3X1 K2X1 K1X1 A5 K3A1 K2A1 K1A1\n", "klartext", "3:", "only X, Y and Z");
}

TEST(Curves, ThePublishedCurvesAreTheSameInAllFourForms) {
    for (const std::string name : {"trident", "butterfly_nurbs"}) {
        const Program forms[] = {parse(file(name + ".ngc"), "linuxcnc"), parse(file(name + ".g6.ngc"), "linuxcnc"),
                                 parse(file(name + ".nc"), "fanuc"), parse(file(name + ".mpf"), "siemens")};
        const std::size_t spans = name == "trident" ? 4 : 48;
        for (const Program& form : forms) {
            ASSERT_EQ(form.motions.curves.size(), spans) << name;
            for (std::size_t i = 0; i < spans; ++i) {
                for (int k = 0; k <= 8; ++k) {
                    // The forms are not parametrised alike, so the nearest point is compared.
                    const Vec3 p = form.motions.curves[i].span->at(k / 8.0);
                    EXPECT_LE(forms[2].motions.curves[i].span->nearest(p).distance, 5e-10) << name << " span " << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace clsurf::curves_test
