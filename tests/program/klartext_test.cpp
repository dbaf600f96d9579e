// HEIDENHAIN Klartext; the expected values are computed by hand next to each program.

#include <gtest/gtest.h>

#include "program/dialects/dialect_guess.h"
#include "program/motion_rows.h"

namespace clsurf::klartext_test {
namespace {

Program program_of(const std::string& text) { return parse(text, "klartext"); }
Rows rows(const std::string& text) { return motions(program_of(text)); }
std::string error(const std::string& text) { return error_of(text, "klartext"); }

TEST(KlartextQ, ArcTangentNeedsNoBrackets) {
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 R0 FMAX\nQ1 = 1\nQ4 = ATAN Q1\nL X+Q4 F100\n"), (Rows{"rapid 0 0 0", "feed 45 0 0"}));
}

TEST(Klartext, ReadsLinesWithFeedsThatStay) {
    const Program p = program_of(
        "0 BEGIN PGM PART MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 BLK FORM 0.2 X+100 Y+100 Z+0\n"
        "3 TOOL CALL 5 Z S8000 F500\n4 L X+10 Y+20 Z+5 R0 FMAX M3\n5 L Z-1 F1000 ; down\n6 L X+0 FMAX\n"
        "7 L IX+5 IY-2.5\n8 * - finishing\n9 L X+1,5 F AUTO\n10 L M9\n11 END PGM PART MM\n");
    EXPECT_EQ(motions(p),
              (Rows{"rapid 10 20 5", "feed 10 20 -1", "rapid 0 20 -1", "feed 5 17.5 -1", "feed 1.5 17.5 -1"}));
    EXPECT_FLOAT_EQ(p.motions.feed[1], 1000 / 60.F);
    EXPECT_FLOAT_EQ(p.motions.feed[3], 1000 / 60.F);
    EXPECT_FLOAT_EQ(p.motions.feed[4], 500 / 60.F);
    EXPECT_EQ(p.motions.line[4], 10U);
    EXPECT_TRUE(p.diagnostics.summary().empty());
    // A block with one axis needs no L.
    EXPECT_EQ(rows("L X+1 Y+1 Z+1 R0 FMAX\nZ+50 R0 F100\n"), (Rows{"rapid 1 1 1", "feed 1 1 50"}));
}

// TNC 620: F is effective until a positioning block or a TOOL CALL block has a new one.
TEST(Klartext, TakesTheFeedOfToolCallUntilTheNextOne) {
    const Program p = program_of(
        "TOOL CALL 1 Z S1000 F600\nL X+0 Y+0 Z+0 FMAX\nL X+10\nL X+20 F120\nTOOL CALL 2 Z S1000\nL X+30\n"
        "TOOL CALL 3 Z S1000 F900\nL X+40\n");
    EXPECT_EQ(p.motions.feed[1] * 60, 600);
    EXPECT_EQ(p.motions.feed[2] * 60, 120);
    EXPECT_EQ(p.motions.feed[3] * 60, 120);
    EXPECT_EQ(p.motions.feed[4] * 60, 900);
    EXPECT_EQ(p.diagnostics.count("program.no-feed"), 0U);
}

TEST(Klartext, DwellsInAnyLanguage) {
    for (const char* word : {"DWELL 1.5", "V.ZEIT 1.5", "V.ZEIT1,5", "DWELL Q1", "Q1"}) {
        const Program p =
            program_of(std::string("Q1 = 1.5\nL X+1 Y+2 Z+3 FMAX\nCYCL DEF 9.0 DWELL\nCYCL DEF 9.1 ") + word + "\n");
        EXPECT_EQ(motions(p), (Rows{"rapid 1 2 3", "dwell 1 2 3"})) << word;
        EXPECT_EQ(p.motions.feed[1], 1.5F) << word;
    }
}

TEST(Klartext, CountsInInchesAndTenthsOfThemForTheFeed) {
    const Program p = program_of("BEGIN PGM PART INCH\nL X+1 Y+0 Z+0 R0 FMAX\nL X+2 F100\nEND PGM PART INCH\n");
    EXPECT_EQ(motions(p), (Rows{"rapid 25.4 0 0", "feed 50.8 0 0"}));
    EXPECT_NEAR(p.motions.feed[1] * 60, 254, 1e-3);
}

TEST(Klartext, TurnsAboutTheCentreByRadiusAndTangent) {
    const Program p = program_of(
        "L X+0 Y+0 Z+0 R0 FMAX\nCC X+10 Y+0\nC X+20 Y+0 DR- F600\nC X+20 Y+0 DR+\nCR X+0 Y+0 R+10 DR+\n"
        "CR X+10 Y+10 R-10 DR-\nL X+20 Y+10\nCT X+20 Y+20\n");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "cw 20 0 0", "ccw 20 0 0", "ccw 0 0 0", "cw 10 10 0", "feed 20 10 0",
                                "ccw 20 20 0"}));
    // From (0, 0) to (10, 10) clockwise by more than a half: about (0, 10). Tangentially from +X: about (20, 15).
    EXPECT_NEAR(p.motions.arcs.at(3).centre.x, 0, 1e-9);
    EXPECT_NEAR(p.motions.arcs.at(3).centre.y, 10, 1e-9);
    EXPECT_NEAR(p.motions.arcs.at(4).centre.y, 15, 1e-9);
    EXPECT_NE(error("L X+0 Y+0 Z+0 FMAX\nCR X+5 DR+ F100\n").find("2:1: error: CR needs its radius"),
              std::string::npos);
}

TEST(Klartext, MovesAboutThePole) {
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nCC X+10 Y+10\nLP PR+5 PA+0 F600\nCP PA+90 DR+\nLP PR+2 PA+180 FMAX\n"
                   "LP IPA+90 F600\nCC\nLP PR+1 PA+0\n"),
              (Rows{"rapid 0 0 0", "feed 15 10 0", "ccw 10 15 0", "rapid 8 10 0", "feed 10 8 0", "feed 11 8 0"}));
    // Two turns down, two millimetres each.
    const Program helix = program_of("L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nCP IPA+720 IZ-4 DR+ F600\n");
    EXPECT_EQ(motions(helix), (Rows{"rapid 10 0 0", "ccw 10 0 -4"}));
    EXPECT_EQ(helix.motions.arcs.at(0).turns, 2);
    EXPECT_NE(error("L X+1 Y+0 Z+0 FMAX\nCC X+0 Y+0\nCP IPA-90 DR+ F1\n").find("IPA and DR"), std::string::npos);
}

TEST(Klartext, CutsCornersBetweenLines) {
    // At (10, 0) from +X to +Y: the arc of 2 mm touches at (8, 0) and (10, 2) about (8, 2).
    const Program p = program_of("L X+0 Y+0 Z+0 FMAX\nL X+10 F600\nRND R2 F60\nL Y+10\nCHF 3\nL X+0\n");
    EXPECT_EQ(motions(p),
              (Rows{"rapid 0 0 0", "feed 8 0 0", "ccw 10 2 0", "feed 10 7 0", "feed 7 10 0", "feed 0 10 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.x, 8, 1e-9);
    EXPECT_NEAR(p.motions.arcs.at(0).centre.y, 2, 1e-9);
    EXPECT_FLOAT_EQ(p.motions.feed[2], 1);
    EXPECT_FLOAT_EQ(p.motions.feed[3], 10);
    EXPECT_EQ(p.motions.line[2], 3U);
    EXPECT_NE(error("L X+0 Y+0 Z+0 FMAX\nL X+10 F600\nRND R20\nL Y+10\n").find("does not fit"), std::string::npos);
    EXPECT_NE(error("L X+0 Y+0 Z+0 FMAX\nL X+10 F600\nRND R2\nC X+0 DR+\n").find("4:1: error: a straight line"),
              std::string::npos);
    EXPECT_NE(error("L X+0 Y+0 Z+0 FMAX\nL X+10 F600\nCHF 2\nQ1 = 3\n").find("4: error: a straight line with feed"),
              std::string::npos);
    EXPECT_NE(error("L X+0 Y+0 Z+0 FMAX\nL X+10 F600\nRND R2\nL Z+10\n").find("working plane"), std::string::npos);
}

TEST(Klartext, CalculatesWithQParameters) {
    // 5 + 2 = 7; 7 / 2 = 3.5; √16 · (1 + 1) = 8.
    EXPECT_EQ(rows("FN 0: Q1 = +5\nFN 1: Q2 = +Q1 + +2\nFN 4: Q3 = +Q2 DIV +2\nQ4 = SQRT 16 * ( 1 + 1 )\n"
                   "L X+Q3 Y-Q4 Z+0 FMAX\n"),
              (Rows{"rapid 3.5 -8 0"}));
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nFN 0: Q1 = +0\nLBL 1\nFN 1: Q1 = +Q1 + +2\nL X+Q1 FMAX\n"
                   "FN 12: IF +Q1 LT +6 GOTO LBL 1\n"),
              (Rows{"rapid 0 0 0", "rapid 2 0 0", "rapid 4 0 0", "rapid 6 0 0"}));
    EXPECT_NE(error("FN 4: Q1 = +1 DIV +0\n").find("division by zero"), std::string::npos);
    EXPECT_NE(error("FN 9: IF +1 EQU +1 GOTO LBL 7\n").find("no label to go to: '7'"), std::string::npos);
}

TEST(Klartext, CallsAndRepeatsLabels) {
    // Label 1 as a subprogram; the section from label 2 on runs once and two more times.
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nCALL LBL 1\nLBL 2\nL IY+1 FMAX\nCALL LBL 2 REP 2\nCALL LBL \"TOP\"\nM30\n"
                   "LBL 1\nL X+5 FMAX\nLBL 0\nLBL \"TOP\"\nL Z+1 FMAX\nLBL 0\n"),
              (Rows{"rapid 0 0 0", "rapid 5 0 0", "rapid 5 1 0", "rapid 5 2 0", "rapid 5 3 0", "rapid 5 3 1"}));
    EXPECT_NE(error("CALL LBL 7 REP2\n").find("no label to repeat: '7'"), std::string::npos);
    EXPECT_NE(error("CALL PGM TNC:\\PARTS\\OTHER.H\n").find("subprogram 'OTHER'"), std::string::npos);
}

TEST(Klartext, ShiftsTurnsMirrorsAndScalesByCycle) {
    // (1, 0) rotated by 90° in the shifted frame: (10, 1).
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+0\n"
                   "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+90\nL X+1 Y+0 FMAX\nCYCL DEF 10.1 ROT+0\n"
                   "CYCL DEF 7.1 X+0\nL X+1 FMAX\n"),
              (Rows{"rapid 0 0 0", "rapid 10 1 0", "rapid 1 1 0"}));
    // 30° and 60° more are 90°, and minus 180° is −90°; ROT without increment starts from zero.
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+30\nCYCL DEF 10.1 IROT+60\n"
                   "L X+2 Y+0 FMAX\nCYCL DEF 10.1 IROT-180\nL X+2 Y+0 FMAX\nCYCL DEF 10.1 ROT+180\nL X+2 Y+0 FMAX\n"),
              (Rows{"rapid 0 0 0", "rapid 0 2 0", "rapid 0 -2 0", "rapid -2 0 0"}));
    EXPECT_NE(error("CYCL DEF 10.1 +30\n").find("expected ROT or IROT"), std::string::npos);
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nCYCL DEF 8.1 X\nL X+1 FMAX\nCYCL DEF 8.1\nCYCL DEF 11.1 SCL 2\nL X+3 FMAX\n"),
              (Rows{"rapid 0 0 0", "rapid -1 0 0", "rapid 6 0 0"}));
    // Scaled by two about X10: 12 becomes 14.
    EXPECT_EQ(rows("CYCL DEF 26.1 X2 Y1 CCX+10 CCY+0\nL X+12 Y+3 Z+0 FMAX\n"), (Rows{"rapid 14 3 0"}));
    EXPECT_EQ(rows("TRANS DATUM AXIS X+5\nL X+1 Y+0 Z+0 FMAX\nTRANS DATUM RESET\nL X+1 FMAX\n"),
              (Rows{"rapid 6 0 0", "rapid 1 0 0"}));
    EXPECT_NE(error("CYCL DEF 19.1 A+30\n").find("PLANE SPATIAL"), std::string::npos);
}

TEST(Klartext, TakesTheToleranceOfCycle32) {
    const Program p = program_of(
        "BEGIN PGM T INCH\nCYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.002\n"
        "CYCL DEF 32.2 HSC-MODE:1 TA3\nL X+0 Y+0 Z+0 FMAX\nCYCL DEF 32.0 TOLERANCE\n"
        "CYCL DEF 32.1\nL X+1 F1\n");
    std::vector<PathMode> modes;
    for (const ProgramEvent& e : p.events) {
        if (e.path_mode()) modes.push_back(*e.path_mode());
    }
    ASSERT_EQ(modes.size(), 3U);
    EXPECT_EQ(modes[1].block_end, BlockEnd::rounded);
    EXPECT_DOUBLE_EQ(modes[1].tolerance, 0.002 * 25.4);
    EXPECT_TRUE(std::isnan(modes[2].tolerance));
    // DIN/ISO writes cycle 32 as G62.
    const Program iso = parse("%T G71 *\nN10 G62 T0.05 P01 0 P02 5*\nN20 G00 G90 X+1*\n", "heidenhain-iso");
    ASSERT_TRUE(iso.events.at(1).path_mode() != nullptr);
    EXPECT_DOUBLE_EQ(iso.events.at(1).path_mode()->tolerance, 0.05);
    EXPECT_EQ(iso.diagnostics.count("program.unknown-word"), 0U);
}

TEST(Klartext, TiltsThePlaneAboutTheFixedAxes) {
    // 90° about X: (x, y, z) is at (x, −z, y).
    EXPECT_EQ(rows("PLANE SPATIAL SPA+90 SPB+0 SPC+0 STAY\nL X+1 Y+2 Z+3 FMAX\nPLANE RESET STAY\nL X+1 FMAX\n"),
              (Rows{"rapid 1 -3 2", "rapid 1 -3 2"}));
    // About X first, then about the fixed Z: (1, −3, 2) is at (3, 1, 2).
    EXPECT_EQ(rows("PLANE SPATIAL SPA+90 SPB+0 SPC+90 STAY\nL X+1 Y+2 Z+3 FMAX\n"), (Rows{"rapid 3 1 2"}));
    EXPECT_EQ(rows("PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY-1 NZ+0 STAY\nL X+1 Y+2 Z+3 FMAX\n"), (Rows{"rapid 1 -3 2"}));
    // TURN orients the tool along the normal of the plane, −Y.
    const Program p =
        program_of("L X+0 Y+0 Z+9 FMAX\nPLANE SPATIAL SPA+90 SPB+0 SPC+0 TURN FMAX\nL X+1 Y+2 Z+3 FMAX\n");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 9", "rapid 0 0 9", "rapid 1 -3 2"}));
    EXPECT_NEAR(p.motions.tool_axis[2].y, -1, 1e-12);
    EXPECT_NE(error("PLANE POINTS P1X+0\n").find("PLANE POINTS is not supported"), std::string::npos);
    EXPECT_NE(error("PLANE SPATIAL SPA+90\n").find("expected SP"), std::string::npos);
}

TEST(Klartext, FollowsTheTipWithM128) {
    const Program p =
        program_of("M128\nLN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 TX+0 TY+0.6 TZ+0.8 F500\nFUNCTION RESET TCPM\nL X+2 F500\n");
    EXPECT_EQ(motions(p), (Rows{"feed 1 2 3", "feed 2 2 3"}));
    EXPECT_NEAR(p.motions.tool_axis[0].y, 0.6, 1e-12);
    EXPECT_NEAR(p.motions.tool_axis[0].z, 0.8, 1e-12);
    EXPECT_EQ(p.events.at(0).value, "M128");
    EXPECT_NE(error("LN X+1 Y+2 Z+3 TX+0 TY+0 TZ+1 F500\n").find("need M128"), std::string::npos);
    // M128 with its own feed, M91 in its block.
    EXPECT_EQ(rows("L X+0 Y+0 Z+0 FMAX\nL X+1 F100 M128 F500\nL X+2\n"),
              (Rows{"rapid 0 0 0", "feed 1 0 0", "feed 2 0 0"}));
}

TEST(Klartext, ReportsCyclesThatItDoesNotCarryOut) {
    const Program p = program_of(
        "CYCL DEF 200 DRILLING ~\n    Q200=+2 ;SET-UP CLEARANCE ~\n    Q201=-20 ;DEPTH\n"
        "L X+Q200 Y+Q201 Z+0 FMAX M99\n");
    EXPECT_EQ(motions(p), (Rows{"rapid 2 -20 0"}));
    EXPECT_EQ(p.diagnostics.count("program.cycle"), 1U);
}

TEST(Klartext, RefusesWordsThatMoveAxesAndAreNotKnown) {
    EXPECT_NE(error("APPR LT X+20 Y+20 LEN15 R0 F100\n").find("1:1: error: APPR is not supported"), std::string::npos);
    EXPECT_NE(error("L X+1 K5 FMAX\n").find("1:7: error: 'K5' is not a word"), std::string::npos);
    EXPECT_NE(error("X+5 R+ F100\n").find("1:5: error: compensation along one axis"), std::string::npos);
    EXPECT_NE(error("L X+1 FZ0.1\n").find("1:7: error: a feed per tooth"), std::string::npos);
    EXPECT_NE(error("G01 X5\n").find("1:1: error: 'G01' is not a statement"), std::string::npos);
}

TEST(Klartext, IsRecognised) {
    const DialectGuess guess = guess_dialect("0 BEGIN PGM PART MM\n1 L X+10 R0 FMAX\n", "part.h");
    EXPECT_EQ(guess.dialect->name, "klartext");
    EXPECT_EQ(guess.reason.substr(0, 22), "'BEGIN PGM' in line 1,");
}

}  // namespace
}  // namespace clsurf::klartext_test
