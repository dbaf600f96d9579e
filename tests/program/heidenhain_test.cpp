// Heidenhain DIN/ISO; the expected values are computed by hand next to each program.

#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::heidenhain_test {
namespace {

Rows rows(const std::string& text) { return motions(parse(text, "heidenhain-iso")); }

TEST(Heidenhain, MirrorsAxesThatStandWithoutANumber) {
    EXPECT_EQ(parse("G00 G90 X0 Y0 Z0*\nG28 X Y*\nX1*\n", "heidenhain-iso").diagnostics.count("program.unknown-word"),
              0u);
}

TEST(Heidenhain, TakesTheCentreAsAPointThatStays) {
    // I and J are absolute and may be in a block before the arc.
    const Program p = parse(
        "%PART G71 *\nN10 G00 G90 X+0 Y+0 Z+5 *\nN20 I+10 J+0 *\nN30 G02 X+20 Y+0 F60 *\nN40 G03 X+0 *\nN50 G91 G02 X+8 I+4 J+0*\n",
        "heidenhain-iso");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 5", "cw 20 0 5", "ccw 0 0 5", "cw 8 0 5"}));
    EXPECT_DOUBLE_EQ(p.motions.arcs.at(1).centre.x, 10);
    EXPECT_DOUBLE_EQ(p.motions.arcs.at(2).centre.x, 4);
}

TEST(Heidenhain, MovesAboutThePole) {
    EXPECT_EQ(rows("G00 G90 X0 Y0 Z0*\nI+10 J+10*\nG11 R+5 H+0 F60*\nG13 H+90*\nG10 R+2 H+180*\nG11 G91 H+90*\n"),
              (Rows{"rapid 0 0 0", "feed 15 10 0", "ccw 10 15 0", "rapid 8 10 0", "feed 10 8 0"}));
    // G29: the pole is where the tool is.
    EXPECT_EQ(rows("G00 G90 X3 Y4 Z0*\nG29*\nG11 R+5 H+90 F60*\n"), (Rows{"rapid 3 4 0", "feed 3 9 0"}));
}

TEST(Heidenhain, ArcsByRadiusAndTangent) {
    // Along +X, then tangentially to (10, 10): half a circle about (10, 5).
    const Program p = parse("G00 G90 X0 Y0 Z0*\nG01 X10 F60*\nG06 X10 Y10*\n", "heidenhain-iso");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 10 0 0", "ccw 10 10 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.y, 5, 1e-12);
    EXPECT_EQ(rows("G00 G90 X0 Y0 Z0*\nG02 X10 R5 F60*\nG05 X0 R5*\n"), (Rows{"rapid 0 0 0", "cw 10 0 0", "cw 0 0 0"}));
}

TEST(Heidenhain, ShiftsTurnsMirrorsAndScalesByCycle) {
    // (1, 0) rotated by 90° in the shifted frame: (10, 1).
    EXPECT_EQ(rows("G00 G90 X0 Y0 Z0*\nG54 X+10 Y+0*\nG73 H+90*\nG01 X1 Y0 F60*\nG73 H+0*\nG54 X0 Y0*\nX1*\n"),
              (Rows{"rapid 0 0 0", "feed 10 1 0", "feed 1 1 0"}));
    EXPECT_EQ(rows("G00 G90 X0 Y0 Z0*\nG28 X*\nG01 X1 F60*\nG28*\nG72 F2*\nX3*\n"),
              (Rows{"rapid 0 0 0", "feed -1 0 0", "feed 6 0 0"}));
    EXPECT_EQ(rows("G00 G90 X0 Y0 Z0*\nG54 X1*\nG91 G54 X2*\nG90 X0*\n"), (Rows{"rapid 0 0 0", "rapid 3 0 0"}));
}

TEST(Heidenhain, CallsAndRepeatsLabels) {
    // Label 1 as a subprogram; the section from label 2 on runs once and two more times.
    EXPECT_EQ(rows("G00 G90 X0 Y0 Z0*\nL1,0*\nG98 L2*\nG91 Y1*\nL2,2*\nG90 Z1*\nM30*\nG98 L1*\nX5*\nG98 L0*\n"),
              (Rows{"rapid 0 0 0", "rapid 5 0 0", "rapid 5 1 0", "rapid 5 2 0", "rapid 5 3 0", "rapid 5 3 1"}));
    EXPECT_NE(error_of("L7,2*\n", "heidenhain-iso").find("no label to repeat"), std::string::npos);
}

TEST(Heidenhain, CountsWithQFunctions) {
    EXPECT_EQ(
        rows(
            "G00 G90 X0 Y0 Z0*\nD00 Q1 P01 +0*\nG98 L3*\nD01 Q1 P01 +Q1 P02 +2*\nX+Q1*\nD12 P01 +Q1 P02 +4 P03 3*\nD03 Q2 P01 +Q1 P02 -1*\nY+Q2*\n"),
        (Rows{"rapid 0 0 0", "rapid 2 0 0", "rapid 4 0 0", "rapid 4 -4 0"}));
    EXPECT_NE(error_of("D04 Q1 P01 1 P02 0*\n", "heidenhain-iso").find("division by zero"), std::string::npos);
}

TEST(Heidenhain, BeginsAndEndsWithItsNameAndUnit) {
    // G70: inches, and tenths of an inch per minute: F100 is 254 mm/min. Nothing after the closing title runs.
    const Program p =
        parse("%PART G70 *\nN10 G00 G90 X+1 Y+0 Z+0 *\nN20 G01 X+2 F100 *\nN99999999 %PART G70 *\nN10 X+9 *\n",
              "heidenhain-iso");
    EXPECT_EQ(motions(p), (Rows{"rapid 25.4 0 0", "feed 50.8 0 0"}));
    EXPECT_NEAR(p.motions.feed[1] * 60, 254, 1e-3);
    EXPECT_EQ(p.diagnostics.count("program.no-end"), 0u);
    EXPECT_NE(error_of("%PART G71 *\nN10 %OTHER *\n", "heidenhain-iso").find("subprogram 'OTHER'"), std::string::npos);
}

TEST(Heidenhain, CountsWithFormulas) {
    // 5 · (2 + 1) − 4 = 11; 2^3 = 8; 3² + √16 = 13; −|−7| = −7. The last '*' ends the block.
    EXPECT_EQ(
        rows(
            "G00 G90 X0 Y0 Z0*\nQ1 = 5*\nQ6 = Q1 * ( 2 + 1 ) - 4 *\nX+Q6*\nQ2 = 2 ^ 3*\nQ3 = SQ 3 + SQRT 16*\nQ4 = NEG ABS -7*\nX+Q2 Y+Q3 Z+Q4*\n"),
        (Rows{"rapid 0 0 0", "rapid 11 0 0", "rapid 8 13 -7"}));
}

TEST(Heidenhain, SetsMachinePositionsAndUnits) {
    EXPECT_EQ(rows("G70*\nG00 G90 X1 Y0 Z0*\nG71*\nZ5 M91*\n"), (Rows{"rapid 25.4 0 0", "rapid 25.4 0 5"}));
}

TEST(Heidenhain, ReportsWhatItDoesNotCarryOut) {
    const Program p = parse(
        "G00 G90 X0 Y0 Z0*\nG01 X10 F60*\nG25 R2*\nY10*\nG26 R3*\nG200 DRILLING Q200=+2 Q201=-20*\n", "heidenhain-iso");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 10 0 0", "feed 10 10 0"}));
    ASSERT_GE(p.diagnostics.count("program.unknown-word"), 3u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:3:1");
}

}  // namespace
}  // namespace clsurf::heidenhain_test
