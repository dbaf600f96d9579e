// Splines: the curves of each dialect's words, their lines, and what is refused. Expected values come from the
// definition of each curve, evaluated here, not from the code that reads them.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "program/motion_rows.h"

namespace clsurf::curves_test {
namespace {

Vec3 at(const Program& program, std::size_t curve, double t) { return program.motions.curves.at(curve).span->at(t); }

void expect_at(const Program& program, std::size_t curve, double t, const Vec3& expected) {
    EXPECT_LE((at(program, curve, t) - expected).norm(), 5e-10) << "curve " << curve << " at " << t;
}

/// Expects a program to be refused: the line and a part of the message.
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
    // Bézier points (0,0) (1,2) (2,2) (3,0); then in the same direction: (3,0) (4,-2) (5,2) (6,0); then (6,0) (7,-2) (8,0).
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
    // Their line is that of the block that makes them, as its kernel reports it.
    EXPECT_EQ(p.motions.line[0], 6U);
}

TEST(Curves, KnotsAndWeightsOfFanuc) {
    // A quarter of a circle: order 3, weights 1, √½, 1.
    const std::string text =
        "G21 G90\nG0 X10 Y0 Z0\nG06.2 P3 K0 X10 Y0 R1 F600\nK0 X10 Y10 R0.70710678118654752\nK0 X0 Y10 R1\nK1\nK1\nK1\nG01 X-5\n";
    const Program p = parse(text, "fanuc");
    EXPECT_EQ(motions(p), (Rows{"rapid 10 0 0", "spline 0 10 0", "feed -5 10 0"}));
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(p, 0, k / 10.0).norm(), 10, 1e-12);
    EXPECT_EQ(p.motions.line[1], 5U);  // the last point that affects the span
    EXPECT_FLOAT_EQ(p.motions.feed[1], 10);
    // The first block without a point or a knot: the position of the tool, and the knot of the second.
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
    expect_refused("G0 X0 Y0 Z0\nG6.2 P3 K0 X1 Y0 F60\n", "fanuc", "2:", "begins where the tool is");
    const std::string begin = "G0 X0 Y0 Z0\nG6.2 P3 K0 X0 Y0 F60\nK0 X1 Y1\nK0 X2 Y0\n";
    expect_refused(begin + "K1\nK1\nG1 X5\n", "fanuc", "7:", "ends with 3 blocks of K alone, here are 2");
    expect_refused(begin + "K1\nK1\n", "fanuc", "", "ends with 3 blocks of K alone, here are 2");
    expect_refused(begin + "X3 Y3\n", "fanuc", "5:", "needs its knot (K)");
    // In the block of the decreasing knot, with or without a point.
    expect_refused(begin + "K-1\nK1\nK1\n", "fanuc", "5:1:", "may not fall: -1 after 0");
    expect_refused(begin + "K2\nN1 K1\nK2\n", "linuxcnc", "6:4:", "may not fall: 1 after 2");
    expect_refused(begin + "X3 Y0 K-1\nK1\nK1\nK1\n", "fanuc", "5:7:", "may not fall: -1 after 0");
    expect_refused("G0 X0 Y0 Z0\nG6.2 P3 X0 Y0 F60\nK1 X1 Y1\nK0 X2 Y0\n", "fanuc", "4:1:", "may not fall: 0 after 1");
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
    // x = (1 − p²)/(1 + p²), y = 2 p/(1 + p²) times 10; z increases linearly with p.
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
    // SINUMERIK, 5-axis machining, reference section: from the zero to (1/4, √3/4), about (1/4, √3/12). The published numbers
    // have three decimals.
    const Program p = parse(
        "G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nPOLY PO[X]=(0.25,0.5,0) PO[Y]=(0.433,0,0) PO[]=(1,1,0)\nG1 X5\n", "siemens");
    for (int k = 0; k <= 10; ++k)
        EXPECT_NEAR((at(p, 0, k / 10.0) - Vec3(0.25, std::sqrt(3.0) / 12, 0)).norm(), std::sqrt(3.0) / 6, 5e-5);
}

TEST(Curves, SplinesThroughPointsEndWithTheMotionsBesideThem) {
    // BTAN and ETAN are the default: the direction of the adjacent blocks.
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
    // Events keep their position.
    const Program events =
        parse("G71 G90\nG0 X0 Y0 Z0\nG1 X10 F1000\nCSPLINE X20 Y0\nM8\nX30 Y10\nX30 Y20\nM9\nG1 X30 Y30\n", "siemens");
    std::vector<std::int64_t> places;
    for (const ProgramEvent& event : events.events) {
        if (event.name == "coolant") places.push_back(event.motion);
    }
    EXPECT_EQ(places, (std::vector<std::int64_t>{3, 5}));
}

// Four spans after G1 X4 Y1, before G1 X40 Y0.
constexpr const char* five_points = "X10 Y8 Z1\nX16 Y3 Z2\nX25 Y11 Z0\nX31 Y2 Z1\n";

Program cubic(const std::string& ends, const std::string& points, const std::string& behind) {
    return parse("G71 G90\nG0 X0 Y0 Z0\nG1 X4 Y1 F1000\n" + ends + " CSPLINE\n" + points + behind, "siemens");
}

/// Checks points between the given ones, and that the curvature is continuous at each of these.
void expect_cubic(const Program& program, const std::vector<Vec3>& middles) {
    ASSERT_EQ(program.motions.curves.size(), middles.size());
    CurveJet before;
    for (std::size_t i = 0; i < middles.size(); ++i) {
        const BezierCurve& span = *program.motions.curves[i].span;
        expect_at(program, i, 0.5, middles[i]);
        // The parameter is the length of the chord.
        const double chord = (span.at(1) - span.at(0)).norm();
        const CurveJet begin = span.jet(0), end = span.jet(1);
        if (i > 0) {
            EXPECT_LE((begin.first / chord - before.first).norm(), 1e-12) << "span " << i;
            EXPECT_LE((begin.second / (chord * chord) - before.second).norm(), 1e-12) << "span " << i;
        }
        before.first = end.first / chord;
        before.second = end.second / (chord * chord);
    }
}

// Expected values for five points: cubic polynomials over the lengths of the chords. numpy.linalg.solve gives the 16
// coefficients of each coordinate from points, slopes, second derivatives and ends; SciPy (interpolate, cubic spline) gives
// the same to 1e-13.
std::vector<Vec3> natural_middles() {
    return {{6.891398592434, 6.228999026127, 0.405462707420},
            {12.923136995222, 5.421233588086, 1.672097044180},
            {20.726524874753, 6.454756312558, 1.114721077529},
            {28.176671959013, 8.590454043176, 0.133599438599}};
}

TEST(CubicSplines, GoThroughAllPointsWithOneCurvature) {
    const std::string line = "G1 X40 Y0\n";
    expect_cubic(cubic("BNAT ENAT", five_points, line), natural_middles());
    expect_cubic(cubic("BTAN ETAN", five_points, line), {{7.414113932983, 4.785793492554, 0.285092137981},
                                                         {12.772816746031, 5.666714278065, 1.711937704112},
                                                         {21.021016691799, 6.882622550018, 1.008663449704},
                                                         {27.356470718757, 6.663577792489, 0.451641703335}});
    // Not-a-knot.
    const std::vector<Vec3> free{{6.777726906652, 8.530401414842, 0.190381144927},
                                 {12.955484051233, 5.014680703022, 1.700078819899},
                                 {20.664987870079, 5.882964525808, 1.241447253572},
                                 {28.346577499071, 11.289903828000, -0.366220902408}};
    expect_cubic(cubic("BAUTO EAUTO", five_points, line), free);
    const std::vector<Vec3> mixed{{6.888486985320, 6.174579540318, 0.415119561794},
                                  {12.930180412873, 5.552878810772, 1.648736317308},
                                  {20.679461487359, 5.575116566502, 1.270815035474},
                                  {28.334661241728, 11.543357780456, -0.390399657449}};
    expect_cubic(cubic("BNAT EAUTO", five_points, line), mixed);
    // Without a motion after it, ETAN is EAUTO.
    expect_cubic(cubic("BNAT ETAN", five_points, "M30\n"), mixed);
}

TEST(CubicSplines, OfFewPoints) {
    // Two ends with the same condition on two spans: a parabola; on one span: a line.
    expect_cubic(cubic("BAUTO EAUTO", "X10 Y8 Z1\nX16 Y3 Z2\n", "M30\n"),
                 {{6.855805778217, 6.242593719722, 0.475967629703}, {12.896046026156, 6.756288495613, 1.482674337693}});
    expect_cubic(cubic("BAUTO EAUTO", "X10 Y9\n", "M30\n"), {{7, 5, 0}});
    expect_cubic(cubic("BNAT ENAT", "X10 Y9\n", "M30\n"), {{7, 5, 0}});
    // From (4, 1) along (4, 1)/√17 to (10, 9) along Y, over 10 mm: (P0 + P1)/2 + 10 (s0 − s1)/8.
    const double root = std::sqrt(17.0);
    expect_cubic(cubic("BTAN ETAN", "X10 Y9\n", "G1 Y20\n"), {{7 + 5 / root, 5 + 1.25 * (1 / root - 1), 0}});
}

// A spline ends where another one begins, with the words that are active in its own blocks.
TEST(CubicSplines, KeepTheirEndsBeforeAnotherSpline) {
    for (const std::string next :
         {"BTAN ETAN ASPLINE X40 Y0\n", "BTAN ETAN BSPLINE X40 Y0\n", "G1\nBAUTO EAUTO CSPLINE X40 Y0\n",
          "ASPLINE\nCSPLINE X40 Y0\n", "G1 ETAN X40 Y0\n"}) {
        Program p = cubic("BNAT ENAT", five_points, next + "M30\n");
        ASSERT_EQ(p.motions.curves.size(), next.starts_with("G1 E") ? 4U : 5U) << next;
        p.motions.curves.resize(4);
        expect_cubic(p, natural_middles());
    }
    // The word ENAT in a separate block before the end of the spline still belongs to it.
    expect_cubic(cubic("BNAT", std::string(five_points) + "ENAT\n", "G1 X40 Y0\n"), natural_middles());
}

TEST(Curves, ControlPointsOfBspline) {
    // Degree 2, weights: the quarter circle; PL of the i-th block is the i-th span.
    const Program circle = parse(
        "G71 G90\nG0 X10 Y0 Z0\nG1 F1000\nBSPLINE X10 Y10 PW=0.70710678118654752 SD=2\nX0 Y10\nG1 X-5\n", "siemens");
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(circle, 0, k / 10.0).norm(), 10, 1e-12);
    const Program uneven =
        parse("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE SD=2 X0 Y4 PL=1\nX4 Y4 PL=3\nX4 Y0 PL=0\nG1 X9\n", "siemens");
    expect_at(uneven, 0, 1, {1, 4, 0});
    // Programs that give each leg its own interval begin and end with 0.
    const Program by_leg = parse(
        "G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE X0 Y4 PL=0\nX4 Y4 PL=1\nX4 Y0 PL=3\nX8 Y0 PL=0\nG1 X9\n", "siemens");
    ASSERT_EQ(by_leg.motions.curves.size(), 2U);
    // Knots 0 0 0 0 1 4 4 4 4: the joint is the blossom at (1, 1, 1).
    expect_at(by_leg, 0, 1, {0.75 * 1 + 0.25 * 4, 0.75 * 4 + 0.25 * 3, 0});
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE X1 PL=1\nX2\nX3 Y1\nX4\nX5\nG1 X9\n", "siemens",
                   "9:", "PL is missing");
    expect_refused("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nBSPLINE X1 A5\n", "siemens", "4:", "rotary axes");
}

// G1 without a motion ends a spline: the next point begins another one at the position of the tool, of one span each.
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
    // The same for interpolated points: two lines are two splines, with a corner between them.
    const Program points =
        parse("G71 G90\nG0 X0 Y0 Z0\nG1 F1000\nASPLINE X1 Y1\nG1\nASPLINE X2 Y0\nG1\nM30\n", "siemens");
    ASSERT_EQ(points.motions.curves.size(), 2U);
}

TEST(Curves, FramesTakeCurvesAlong) {
    const Program p =
        parse("G71 G90\nTRANS X100\nAROT Z90\nG0 X0 Y0 Z0\nG1 F1000\nPOLY PO[X]=(4,2) Y2\nG1 X0\n", "siemens");
    // In programmed coordinates x = 2 p + 2 p², y = 2 p; rotated by 90° and shifted.
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
    // At t = ½; the beginning is the tool's position, off by 0.71 µm and 1.08 µm, of which an eighth remains there.
    const double x =
        24.875 + (-4.688e-2 / 8 + 2.459e-2 / 4 + 3.486 / 2) - (24.875 - 4.688e-2 + 2.459e-2 + 3.486 - 28.338) / 8;
    EXPECT_NEAR(at(p, 0, 0.5).x(), x, 1e-12);
    expect_refused("0 BEGIN PGM A MM\n1 L X+28 Y+19.385 Z-0.5 FMAX\n" + block, "klartext",
                   "3:", "the tool is at 28.0000");
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
                    // The forms have different parametrisations, so the nearest point is compared.
                    const Vec3 p = form.motions.curves[i].span->at(k / 8.0);
                    EXPECT_LE(forms[2].motions.curves[i].span->nearest(p).distance, 5e-10) << name << " span " << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace clsurf::curves_test
