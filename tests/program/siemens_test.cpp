// SINUMERIK; the expected values are computed by hand next to each program.

#include <map>

#include <gtest/gtest.h>

#include "core/units.h"
#include "program/motion_rows.h"

namespace clsurf::siemens_test {
namespace {

Rows rows(const std::string& text) { return motions(parse(text, "siemens")); }

TEST(SiemensFrames, ReplaceOrAdd) {
    // TRANS replaces, ATRANS adds; TRANS alone ends all.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nTRANS X10 Y5\nX1 Y0\nATRANS Z3\nX2 Z0\nTRANS X1\nX0 Y0 Z0\nTRANS\nX0\n"),
              (Rows{"rapid 0 0 0", "rapid 11 5 0", "rapid 12 5 3", "rapid 1 0 0", "rapid 0 0 0"}));
    // Rotated by 90° in the shifted frame: (2, 0) → (10, 2). Then the axes of the rotated frame: +1 in its X.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nTRANS X10\nAROT RPL=90\nX2 Y0\nATRANS X1\nX2 Y0\n"),
              (Rows{"rapid 0 0 0", "rapid 10 2 0", "rapid 10 3 0"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nMIRROR X0\nX2 Y1\nASCALE X3\nX2\n"),
              (Rows{"rapid 0 0 0", "rapid -2 1 0", "rapid -6 1 0"}));
    // ROT X90: Y → Z; an arc of G17 becomes one of G18, Y down: the same rotation about −Y, so the opposite one about +Y.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nROT X90\nG1 F60 Y5\nG3 X0 Y-5 I0 J-5\n"),
              (Rows{"rapid 0 0 0", "feed 0 0 5", "cw 0 0 -5"}));
    EXPECT_NE(error_of("SCALE X0\n", "siemens").find("a factor of 0"), std::string::npos);
}

TEST(SiemensSwivel, TurnsAxisByAxisAndMoves) {
    const auto axis = [](const Program& p, std::size_t i) { return Vec3(p.motions.tool_axis[i].vec()); };
    // Mode 57: X, Y, Z. About X by 90°: (1, 2, 3) → (1, −3, 2); shifted by (10, 20, 30) before, by (0, 0, 5) after it.
    Program p = parse(
        "G0 X0 Y0 Z0\nCYCLE800(0,\"TC\",100000,57,10,20,30,90,0,0,0,0,5,1)\nG1 X1 Y2 Z3 F60\nTRANS X1\nX1 Y2 Z3\nCYCLE800()\nG0 X0 Y0 Z0\n",
        "siemens");
    EXPECT_EQ(p.diagnostics.count("program.rotation"), 0u);
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "rapid 0 0 0", "feed 11 12 32", "feed 12 12 32", "rapid 0 0 0"}));
    EXPECT_LE((axis(p, 2) - Vec3(0, -1, 0)).norm(), 1e-12);
    EXPECT_TRUE(std::isnan(p.motions.tool_axis[4].x));
    // Mode 27: Z, Y, X. Z by 90° first, then the new Y, which is −x, by 90°: the normal is +y.
    p = parse("G0 X0 Y0 Z0\nCYCLE800(1,\"TC\",200000,27,0,0,0,90,90,0,0,0,0,-1,100,1)\n", "siemens");
    EXPECT_LE((axis(p, 1) - Vec3(0, 1, 0)).norm(), 1e-12) << axis(p, 1).transpose();
    // Added to it: by 90° about the X of that plane, which points down now: x' = −z, the normal moves from y to x.
    p = parse(
        "G0 X0 Y0 Z0\nCYCLE800(1,\"TC\",200000,27,0,0,0,90,90,0,0,0,0,-1)\nCYCLE800(1,\"TC\",200001,57,0,0,0,90,0,0,0,0,0,-1)\n",
        "siemens");
    EXPECT_LE((axis(p, 2) - Vec3(1, 0, 0)).norm(), 1e-12) << axis(p, 2).transpose();
    // Direction 0: only the frame, the program turns the axes.
    p = parse("G0 X0 Y0 Z0\nCYCLE800(0,\"TC\",100000,57,0,0,0,90,0,0,0,0,0,0)\nG1 X1 Y2 Z3 A-90 F60\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 1 -3 2"}));
    EXPECT_TRUE(p.motions.tool_axis.empty());
}

TEST(SiemensSwivel, NamesWhatItCannotDo) {
    for (const char* mode : {"64", "128", "192"}) {
        const Program p = parse(
            std::string("G0 X0 Y0 Z0\nCYCLE800(0,\"TC\",100000,") + mode + ",0,0,0,10,20,0,0,0,0,1)\nX1\n", "siemens");
        ASSERT_EQ(p.diagnostics.count("program.rotation"), 1u) << mode;
        EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:2:1");
        EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "rapid 1 0 0"}));
    }
    EXPECT_NE(
        error_of("CYCLE800(0,\"TC\",0,9,0,0,0,10,20,30,0,0,0,1)\n", "siemens").find("has no axis for the angle 30"),
        std::string::npos);
}

/// C at the end of every motion [deg].
std::vector<double> turned(const std::string& text) {
    std::vector<double> all;
    for (const Xyz& angles : parse(text, "siemens").motions.rotary) all.push_back(angles.z * deg_per_rad);
    return all;
}

void expect_turned(const std::string& text, const std::vector<double>& expected) {
    const std::vector<double> all = turned(text);
    ASSERT_EQ(all.size(), expected.size()) << text;
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(all[i], expected[i], 1e-9) << text << "motion " << i;
}

TEST(SiemensRotaryAxes, TurnTheShortWayOrInTheGivenDirection) {
    // 350° to 10°: 20° forward, and 20° back; from 10° to 190° both directions are 180°: forward.
    expect_turned("G0 C350\nC=DC(10)\nC=DC(350)\nC=DC(10)\nC=DC(190)\nC=DC(190)\n", {350, 370, 350, 370, 550, 550});
    // From 10°: to 350° forward by 340°, to 10° back by 340°, to 350° back by 20°, to 10° forward by 20°.
    expect_turned("G0 C10\nC=ACP(350)\nC=ACN(10)\nC=ACN(350)\nC=ACP(10)\nC=ACP(10)\nC=ACN(10)\n",
                  {10, 350, 10, -10, 10, 10, 10});
    // A position is reduced to one turn, also beyond it; rounding adds no turn: 359.999° to 0° is 0.001°.
    expect_turned("G0 C359.999\nC=DC(360)\nC=ACP(0)\nC=ACN(0)\nC=DC(-90)\n", {359.999, 360, 360, 360, 270});
    expect_turned("G0 C0.1\nG91 C=DC(0.3)\nC=ACN(0.1)\nC5\n", {0.1, 0.3, 0.1, 5.1});
}

TEST(SiemensRotaryAxes, AModuloAxisStaysInItsTurn) {
    // 10° of the second turn. 20° and AC(30) are in that turn; IC(350) leads to the third, where 5° is 15° back.
    expect_turned("G0 C350\nC=DC(10)\nC20\nC=AC(30)\nC=IC(350)\nC5\n", {350, 370, 380, 390, 740, 725});
    // An axis without any of these words is not reduced to a turn.
    expect_turned("G0 C370\nC10\nC-350\n", {370, 10, -350});
    // Each axis by itself.
    const Program p = parse("G0 A350 C350\nA=ACP(10) C10\n", "siemens");
    EXPECT_NEAR(p.motions.rotary[1].x, 370 * rad_per_deg, 1e-12);
    EXPECT_NEAR(p.motions.rotary[1].z, 10 * rad_per_deg, 1e-12);
    // A linear axis has no turns.
    EXPECT_EQ(rows("G0 X350 Y0 Z0\nX=DC(10)\n"), (Rows{"rapid 350 0 0", "rapid 10 0 0"}));
}

TEST(SiemensRotaryAxes, CountTheFeedOfTheWayThatTheyTurn) {
    // 20° at 600°/min.
    const Program p = parse("G0 X0 Y0 Z0 C350\nG1 C=DC(10) F600\n", "siemens");
    EXPECT_NEAR(p.motions.feed[1], 10, 1e-6);
}

TEST(SiemensPoles, AreAtTheToolTheZeroOrTheLastPole) {
    // Poles (10, 10), one to the right of the tool (11, 15), three above that one (11, 18).
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG111 X10 Y10\nG1 F60 RP=5 AP=0\nAP=90\nG110 X1\nRP=2 AP=180\nG112 Y3\nRP=2 AP=90\n"),
              (Rows{"rapid 0 0 0", "feed 15 10 0", "feed 10 15 0", "feed 9 15 0", "feed 11 20 0"}));
    // Increments of angle and radius.
    EXPECT_EQ(rows("G0 X10 Y0 Z0\nG111 X0 Y0\nG1 F60 AP=IC(90)\nRP=IC(5)\n"),
              (Rows{"rapid 10 0 0", "feed 0 10 0", "feed 0 15 0"}));
    // An arc about the pole.
    const Program p = parse("G0 X10 Y0 Z0\nG111 X0 Y0\nG3 F60 RP=10 AP=90\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 10 0 0", "ccw 0 10 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.x, 0, 1e-12);
}

TEST(SiemensArcs, ByAngleByPointsAndByRadius) {
    // AR with I J: a quarter about (10, 0) ends at (10, −10). AR with the end: half a circle of chord 10.
    Program p = parse("G0 X0 Y0 Z0\nG3 F60 I10 J0 AR=90\nG2 X20 Y-10 AR=180\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "ccw 10 -10 0", "cw 20 -10 0"}));
    EXPECT_NEAR(p.motions.arcs.at(1).centre.x, 15, 1e-9);
    // Through (5, 5): half a circle above, clockwise, about (5, 0).
    p = parse("G0 X0 Y0 Z0\nCIP X10 Y0 I1=5 J1=5 F60\nCIP X10 Y10 I1=15 J1=5\nG1 X0\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "cw 10 0 0", "ccw 10 10 0", "feed 0 10 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.x, 5, 1e-9);
    EXPECT_NE(error_of("G0 X0 Y0 Z0\nCIP X10 I1=5 F60\n", "siemens").find("on a line"), std::string::npos);
    // CR negative: the long arc; TURN: one more full circle.
    p = parse("G0 X0 Y0 Z0\nG2 X10 Y0 CR=-10 F60\nG3 X0 Y0 Z-6 I-5 J0 TURN=2\n", "siemens");
    EXPECT_GT(p.motions.arcs.at(0).centre.y, 0);
    EXPECT_EQ(p.motions.arcs.at(1).turns, 3);
}

TEST(SiemensArcs, TakePointsAsIncrementsAndGoOnAlongTheTangent) {
    // Through (5, 15) from (5, 5) to (15, 15): about (10, 10), clockwise.
    Program p =
        parse("G0 X5 Y5 Z0\nCIP X15 Y15 I1=IC(0) J1=IC(10) F60\nG91 CIP X-10 Y-10 I1=AC(15) J1=AC(5)\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 5 5 0", "cw 15 15 0", "cw 5 5 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.x, 10, 1e-9);
    EXPECT_NEAR(p.motions.arcs.at(1).centre.y, 10, 1e-9);
    // Along +X, then tangentially to (20, 10): a quarter about (10, 10), and on to (10, 20). G1 ends it.
    p = parse("G0 X0 Y0 Z0\nG1 X10 F60\nCT X20 Y10\nX10 Y20\nG1 X0\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 10 0 0", "ccw 20 10 0", "ccw 10 20 0", "feed 0 20 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.x, 10, 1e-9);
    EXPECT_NEAR(p.motions.arcs.at(1).centre.y, 10, 1e-9);
}

TEST(SiemensLines, EndWhereTheAngleMeetsACoordinate) {
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG1 X10 ANG=45 F60\nY0 ANG=-90\nX0 ANG=180\n"),
              (Rows{"rapid 0 0 0", "feed 10 10 0", "feed 10 0 0", "feed 0 0 0"}));
    const Program p = parse("G0 X0 Y0 Z0\nG1 ANG=45 F60\nX10 Y20 ANG=90\n", "siemens");
    ASSERT_EQ(p.diagnostics.count("program.corner"), 2u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:2:4");
    EXPECT_NE(error_of("G0 X0 Y0\nG1 X10 ANG=90 F60\n", "siemens").find("does not reach the given X"),
              std::string::npos);
}

TEST(SiemensCycles, TapByPitchAndSpeed) {
    const auto feeds = [](const std::string& text) {
        const Program tapped = parse("G0 X1 Y1 Z10\nG95 F7 S100\n" + text + "\n", "siemens");
        const Rows ways{"rapid 1 1 10", "rapid 1 1 2", "feed 1 1 -6", "feed 1 1 2", "rapid 1 1 10"};
        EXPECT_EQ(motions(tapped), ways) << text;
        return std::pair(std::round(tapped.motions.feed[2] * 60), std::round(tapped.motions.feed[3] * 60));
    };
    // Pitch 1.25 at 500 rpm, out at 800: 625 and 1000 mm/min; the same for a left-hand thread.
    EXPECT_EQ(feeds("CYCLE84(10,0,2,-6,,0,3,,1.25,0,500,800)"), std::pair(625.F, 1000.F));
    EXPECT_EQ(feeds("CYCLE84(10,0,2,-6,,0,3,,-1.25,0,500,0)"), std::pair(625.F, 625.F));
    // M10: 1.5 mm. 20 threads per inch: 1.27 mm. Without SST the speed of the program, as in CYCLE840.
    EXPECT_EQ(feeds("CYCLE84(10,0,2,-6,,0,3,10,,0,400)"), std::pair(600.F, 600.F));
    EXPECT_EQ(feeds("CYCLE84(10,0,2,-6,,0,3,,20,0,1000,0,3,2)"), std::pair(1270.F, 1270.F));
    EXPECT_EQ(feeds("CYCLE84(10,0,2,-6,,0,3,,1.25)"), std::pair(125.F, 125.F));
    EXPECT_EQ(feeds("CYCLE840(10,0,2,-6,,0,4,3,0,,1.5)"), std::pair(150.F, 150.F));
    // Without a pitch the active feed, 7 mm per turn.
    EXPECT_EQ(feeds("CYCLE840(10,0,2,-6,,0,4,3,1)"), std::pair(700.F, 700.F));
}

TEST(SiemensCycles, DrillOnceOrAfterEveryMotion) {
    // RTP 10, RFP 0, SDIS 2, DP −5.
    EXPECT_EQ(rows("G0 X1 Y1 Z20 F60\nCYCLE81(10,0,2,-5)\n"),
              (Rows{"rapid 1 1 20", "rapid 1 1 2", "feed 1 1 -5", "rapid 1 1 10"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z10 F60\nMCALL CYCLE82(10,0,2,,4,0.5)\nX1\nX2\nMCALL\nX3\n"),
              (Rows{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 2", "feed 1 0 -4", "dwell 1 0 -4", "rapid 1 0 10",
                    "rapid 2 0 10", "rapid 2 0 2", "feed 2 0 -4", "dwell 2 0 -4", "rapid 2 0 10", "rapid 3 0 10"}));
    // Tapping retracts with feed, and so does boring with CYCLE85.
    EXPECT_EQ(rows("G0 X1 Y1 Z10 F60\nCYCLE84(10,0,2,-5,,,,,1)\n"),
              (Rows{"rapid 1 1 10", "rapid 1 1 2", "feed 1 1 -5", "feed 1 1 2", "rapid 1 1 10"}));
    const Program p = parse("G0 X1 Y1 Z10 F60\nCYCLE85(10,0,2,-5,,0,120,240)\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 1 1 10", "rapid 1 1 2", "feed 1 1 -5", "feed 1 1 2", "rapid 1 1 10"}));
    EXPECT_FLOAT_EQ(p.motions.feed[2], 2);
    EXPECT_FLOAT_EQ(p.motions.feed[3], 4);
    EXPECT_EQ(rows("G0 X1 Y1 Z10 F60\nCYCLE86(10,0,2,-5,,0,3,-0.5,0,0)\n"),
              (Rows{"rapid 1 1 10", "rapid 1 1 2", "feed 1 1 -5", "rapid 0.5 1 -5", "rapid 0.5 1 2", "rapid 0.5 1 10",
                    "rapid 1 1 10"}));
}

TEST(SiemensCycles, PeckByDegression) {
    // 20 deep, 8 first, then 3 less each: 8, 5, then 3; 4 remain, so not 3 but 2 and 2 (ends 8, 13, 16, 18, 20).
    EXPECT_EQ(rows("G0 X0 Y0 Z5 F60\nCYCLE83(5,0,1,-20,,-8,,3,0,0,1,0)\n"),
              (Rows{"rapid 0 0 5", "rapid 0 0 1", "feed 0 0 -8", "feed 0 0 -7", "feed 0 0 -13", "feed 0 0 -12",
                    "feed 0 0 -16", "feed 0 0 -15", "feed 0 0 -18", "feed 0 0 -17", "feed 0 0 -20", "rapid 0 0 5"}));
    // Chip removal: to R and back to 0.6 above.
    EXPECT_EQ(rows("G0 X0 Y0 Z5 F60\nCYCLE83(5,0,1,-4,,,2,0,0,0,1,1)\n"),
              (Rows{"rapid 0 0 5", "rapid 0 0 1", "feed 0 0 -2", "rapid 0 0 1", "rapid 0 0 -1.4", "feed 0 0 -4",
                    "rapid 0 0 5"}));
}

TEST(SiemensVariables, ArraysAreSetWhereTheyAreDefined) {
    const std::string use = "G90 G0 X0 Y0 Z0\nG1 F60 X=A[2] Y=B[1,0]\n";
    const Rows expected{"rapid 0 0 0", "feed 3.5 3 0"};
    EXPECT_EQ(rows("DEF REAL A[3]=SET(1.5,2.5,3.5)\nDEF REAL B[2,2]=SET(1,2,3,4)\n" + use), expected);
    EXPECT_EQ(rows("DEF REAL A[3]=(1.5,2.5,3.5), B[2,2]=(1,2,3)\n" + use), expected);
    EXPECT_NE(error_of("DEF REAL A[2]=SET(1,2,3)\n" + use, "siemens").find("fewer elements"), std::string::npos);
}

TEST(SiemensCycles, AHoleThatTakesTooManyPecksIsRefused) {
    EXPECT_NE(error_of("G0 X0 Y0 Z5 F60\nCYCLE83(5,0,1,-30,,,0.00001,0,0,0,1,0)\n", "siemens").find("too many pecks"),
              std::string::npos);
}

TEST(SiemensCycles, FollowPatternsAndReportPockets) {
    EXPECT_EQ(rows("G0 X0 Y0 Z5 F60\nMCALL CYCLE81(5,0,1,-2)\nHOLES1(10,0,90,1,2,2)\nMCALL\n"),
              (Rows{"rapid 0 0 5", "rapid 10 1 5", "rapid 10 1 1", "feed 10 1 -2", "rapid 10 1 5", "rapid 10 3 5",
                    "rapid 10 3 1", "feed 10 3 -2", "rapid 10 3 5"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z5\nHOLES2(0,0,10,0,0,4)\n"),
              (Rows{"rapid 0 0 5", "rapid 10 0 5", "rapid 0 10 5", "rapid -10 0 5", "rapid 0 -10 5"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z5\nCYCLE801(0,0,0,5,2,2,2)\n"),
              (Rows{"rapid 0 0 5", "rapid 0 0 5", "rapid 5 0 5", "rapid 5 2 5", "rapid 0 2 5"}));
    const Program p = parse("G0 X0\nPOCKET3(5,0,1,-5)\n", "siemens");
    ASSERT_EQ(p.diagnostics.count("program.cycle"), 1u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:2:1");
}

TEST(SiemensFlow, JumpsAndLoops) {
    EXPECT_EQ(
        rows(
            "DEF INT _N=0\nG0 X0 Y0 Z0\nAGAIN: _N=_N+1\nX=_N\nIF _N<2 GOTOB AGAIN\nGOTOF DONE\nX99\nDONE:\nFOR R1=5 TO 6\nY=R1\nENDFOR\nWHILE R1>5\nR1=R1-1\nENDWHILE\nZ=R1\n"
            "LOOP\nR1=R1+1\nIF R1==8\nGOTOF OUT\nENDIF\nENDLOOP\nOUT: X=R1\nREPEAT\nR1=R1+1\nUNTIL R1>=10\nY=R1\nM30\n"),
        (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 2 0 0", "rapid 2 5 0", "rapid 2 6 0", "rapid 2 6 5", "rapid 8 6 5",
              "rapid 8 10 5"}));
    // A section is repeated from its label on, two more times.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nSECTION: G91 X1\nREPEAT SECTION P=2\nG90 Y1\nM30\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 2 0 0", "rapid 3 0 0", "rapid 3 1 0"}));
}

TEST(SiemensFlow, RepeatsBlocksAndSections) {
    // One block three more times; the lines between two labels, including the second; up to ENDLABEL.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nPOS: G91 X1 Y2\nREPEATB POS P=3\nM30\n"),
              (Rows{"rapid 0 0 0", "rapid 1 2 0", "rapid 2 4 0", "rapid 3 6 0", "rapid 4 8 0"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nBEGIN: G91 X1\nUNTIL_HERE: Y1\nZ1\nREPEAT BEGIN UNTIL_HERE P=2\nG90 Z9\nM30\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 1 1 0", "rapid 1 1 1", "rapid 2 1 1", "rapid 2 2 1",
                    "rapid 3 2 1", "rapid 3 3 1", "rapid 3 3 9"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nHERE: G91 X1\nENDLABEL:\nZ1\nREPEAT HERE\nM30\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 1 0 1", "rapid 2 0 1"}));
    // Nested sections: AA runs BB two more times each time.
    EXPECT_EQ(rows("G0 X0 Y0 Z0 G91\nBB: X1\nAA: Y1\nREPEATB BB P=2\nREPEAT AA P=1\nM30\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 1 1 0", "rapid 2 1 0", "rapid 3 1 0", "rapid 3 2 0",
                    "rapid 4 2 0", "rapid 5 2 0"}));
    // A jump out of a section ends its repetition: otherwise X3 would return to the second repetition.
    EXPECT_EQ(
        rows(
            "R1=0\nGOTOF START\nAA: R1=R1+1\nX=R1\nIF R1==2 GOTOF OUT\nENDLABEL:\nM30\nSTART: G0 X0\nREPEAT AA P=5\nM30\nOUT: X3\nM30\n")
            .size(),
        4u);
    EXPECT_NE(error_of("REPEAT NOWHERE P=2\n", "siemens").find("no label 'NOWHERE'"), std::string::npos);
}

TEST(SiemensFlow, ChoosesByCase) {
    const std::string program =
        "CASE R1 OF 1 GOTOF A1 2 GOTOF A2 DEFAULT GOTOF A3\nA1: G0 X1\nM30\nA2: G0 X2\nM30\nA3: G0 X3\nM30\n";
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nR1=2\n" + program).back(), "rapid 2 0 0");
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nR1=7\n" + program).back(), "rapid 3 0 0");
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nGOTOC NOWHERE\nX1\n").back(), "rapid 1 0 0");
}

TEST(SiemensExpressions, FollowTheManualsPriorities) {
    // Bits before AND before OR, comparisons last: 6 B_OR 1 is 7; 2 == (1 AND 1) is false.
    EXPECT_EQ(rows("G0 X=6 B_OR 1 Y=6 B_AND 3 Z=6 B_XOR 3\n"), (Rows{"rapid 7 2 5"}));
    EXPECT_EQ(rows("G0 X=(2 == 1 AND 1) Y=(1 + 2 == 3) Z=((2 == 2) AND (3 > 1))\n"), (Rows{"rapid 0 1 1"}));
    EXPECT_EQ(rows("G0 X=MINVAL(3,R1) Y=MAXVAL(3,4) Z=BOUND(0,10,12)\n"), (Rows{"rapid 0 4 10"}));
}

TEST(SiemensUnits, G70TakesLengthsAndLeavesFeeds) {
    const Program p = parse("G0 X0 Y0 Z0\nG70 G1 X1 F60\nG700 X2\nG71 X10\n", "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 25.4 0 0", "feed 50.8 0 0", "feed 10 0 0"}));
    EXPECT_FLOAT_EQ(p.motions.feed[1], 1);      // 60 mm/min
    EXPECT_FLOAT_EQ(p.motions.feed[2], 25.4F);  // 60 in/min
}

TEST(SiemensFlow, CallsFilesBesideTheProgramWithArguments) {
    const std::map<std::string, std::string> files{
        {"SLOT_A", "PROC SLOT_A(REAL _X, REAL _D=3)\nG1 F60 X=_X Z=-_D\nRET\n"}, {"L12", "G0 Y12\nM17\n"}};
    const auto text = std::make_shared<std::string>(
        "G0 X0 Y0 Z0\nSLOT_A(4,2)\nSLOT_A(5)\nL12\nEXTCALL \"SLOT_A\"\nEXTCALL(\"/nc/_N_L12_SPF\")\nM30\n");
    InterpreterOptions options;
    options.dialect = find_dialect("siemens");
    options.load = [&](const std::string& name) -> std::optional<SourceText> {
        const auto found = files.find(name);
        if (found == files.end()) return std::nullopt;
        return SourceText(name, found->second, nullptr);
    };
    EXPECT_EQ(motions(parse_program(SourceText("test.nc", *text, text), options)),
              (Rows{"rapid 0 0 0", "feed 4 0 -2", "feed 5 0 -3", "rapid 5 12 -3", "feed 0 12 -3", "rapid 0 12 -3"}));
    EXPECT_NE(error_of("EXTCALL(\"NOWHERE\")\n", "siemens").find("test.nc:1:1: error: subprogram 'NOWHERE' is neither"),
              std::string::npos);
}

TEST(SiemensVariables, AreNumbersArraysAndTheControls) {
    const Program p = parse(
        "DEF REAL A[3], B=2\nDEF STRING[20] NAME=\"X\"\nA[1]=B*3\nR[5]=7\nG0 X=A[1] Y=R5 Z=A[2]\nX=$P_UIFR[1]+1\n",
        "siemens");
    EXPECT_EQ(motions(p), (Rows{"rapid 6 7 0", "rapid 1 7 0"}));
    EXPECT_EQ(p.diagnostics.count("program.variable"), 1u);
}

TEST(SiemensModes, AreNotedOrHalveDiameters) {
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nDIAMON\nX10\nDIAMOF\nX10\n"), (Rows{"rapid 0 0 0", "rapid 5 0 0", "rapid 10 0 0"}));
    const Program p = parse("G0 X1 FNORM STOPRE\nMSG(\"ROUGH (1)\")\nG642 SOFT\nX2 RND=2\nX3\n", "siemens");
    EXPECT_EQ(p.diagnostics.count("program.corner"), 1u);
    EXPECT_EQ(p.diagnostics.count("program.unknown-word"), 0u);
    EXPECT_EQ(p.motions.size(), 3);
}

TEST(SiemensPolar, AddsAnIncrementOfTheThirdAxisOnce) {
    EXPECT_EQ(motions(parse("G0 X0 Y0 Z5\nG111 X0 Y0\nG1 RP=5 AP=90 Z=IC(-1) F60\nM30\n", "siemens")),
              (Rows{"rapid 0 0 5", "feed 0 5 4"}));
}

TEST(SiemensVariables, OfTheControlAreToldToBeDeclared) {
    const std::string said = error_of("G90\nG1 X=_ZSD_LENGTH+3 F1000\n", "siemens");
    EXPECT_NE(said.find("'_ZSD_LENGTH' is neither a function nor a variable that was set"), std::string::npos) << said;
    try {
        (void)parse("G90\nG1 X=_ZSD_LENGTH+3 F1000\n", "siemens");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(error.diagnostic().hint.find("DEF REAL _ZSD_LENGTH="), std::string::npos);
    }
    EXPECT_EQ(error_of("DEF REAL _ZSD_LENGTH=2\nG90\nG1 X=_ZSD_LENGTH+3 F1000\n", "siemens"), "");
}

}  // namespace
}  // namespace clsurf::siemens_test
