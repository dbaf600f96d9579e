// Fanuc and HNC; the expected values are computed by hand next to each program.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::fanuc_test {
namespace {

Rows rows(const std::string& text) { return motions(parse(text, "fanuc")); }

Program parse_with_tool(const std::string& text, const char* dialect) {
    const auto kept = std::make_shared<std::string>(text);
    InterpreterOptions options;
    options.dialect = find_dialect(dialect);
    options.tools.emplace();
    options.tools->tools[1] = Tool{.number = 1, .offset = Vec3(0, 0, 50), .diameter = 4};
    return parse_program(SourceText("test.nc", *kept, kept), options);
}

TEST(FanucFrame, TurnsAboutItsCentre) {
    // About (10, 0) by 90°: (20, 0) → (10, 10), (20, 5) → (5, 10). Increments are also rotated.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG68 X10 Y0 R90\nG1 F60 X20 Y0\nG91 Y5\nG90 G69 X1 Y1\n"),
              (Rows{"rapid 0 0 0", "feed 10 10 0", "feed 5 10 0", "feed 1 1 0"}));
    // Without a centre: about the present position.
    EXPECT_EQ(rows("G0 X5 Y0 Z0\nG68 R180\nG1 F60 X6 Y1\n"), (Rows{"rapid 5 0 0", "feed 4 -1 0"}));
}

TEST(FanucFrame, TurnsArcsWithTheirCentres) {
    const Program p = parse("G0 X0 Y0 Z0\nG68 X0 Y0 R90\nG2 F60 X10 Y0 I5 J0\n", "fanuc");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "cw 0 10 0"}));
    EXPECT_NEAR(p.motions.arcs.at(0).centre.y, 5, 1e-12);
}

TEST(FanucFrame, TurnsAboutAnyAxisInSpace) {
    // About Y by 90°: X → −Z, Z → X. Half a circle in XY becomes one in YZ: G19, same direction of rotation.
    const Program p = parse("G0 X0 Y0 Z0\nG68 X0 Y0 Z0 I0 J1 K0 R90\nG1 F60 X10\nG3 X-10 Y0 I-10 J0\n", "fanuc");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "feed 0 0 -10", "ccw 0 0 10"}));
    EXPECT_EQ(p.motions.arcs.at(0).axis, 0);
    // Tilted by 45° it is in no principal plane: chords.
    const Program tilted = parse("G0 X0 Y0 Z0\nG68 X0 Y0 Z0 I0 J1 K0 R45\nG1 F60 X10\nG3 X-10 Y0 I-10 J0\n", "fanuc");
    const Motions& m = tilted.motions;
    EXPECT_TRUE(m.arcs.empty());
    for (std::int64_t i = 2; i < m.size(); ++i) {
        EXPECT_NEAR(m.end[static_cast<std::size_t>(i)].vec().norm(), 10, 1e-9);
        const Vec3 middle = 0.5 * (m.begin_of(i).vec() + m.end[static_cast<std::size_t>(i)].vec());
        EXPECT_NEAR(middle.norm(), 10, 1e-3);
    }
}

TEST(FanucFrame, ScalesAndMirrors) {
    // About (10, 10) by 2 (P2000): (20, 10) → (30, 10). G50 ends it.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG51 X10 Y10 Z0 P2000\nG1 F60 X20 Y10\nG50 X20\n"),
              (Rows{"rapid 0 0 0", "feed 30 10 0", "feed 20 10 0"}));
    // I −1: mirrored about X 5; a clockwise arc becomes counter-clockwise.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG51 X5 Y0 I-1000 J1000\nG1 F60 X0\nG2 X2 I1\n"),
              (Rows{"rapid 0 0 0", "feed 10 0 0", "ccw 8 0 0"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG51.1 X0\nG1 F60 X3\nG50.1 X0\nX3\n"),
              (Rows{"rapid 0 0 0", "feed -3 0 0", "feed 3 0 0"}));
    EXPECT_NE(error_of("G51 P0\n", "fanuc").find("a factor of 0"), std::string::npos);
}

TEST(FanucFrame, UnevenFactorsMakeAnEllipseOfChordsWithinAMicrometre) {
    // x = 2 · 500 cos t, y = 500 sin t: a hundred chords would deviate by 0.1 mm.
    const Program p = parse("G0 X0 Y0 Z0\nG51 X0 Y0 I2000 J1000\nG1 F600 X500 Y0\nG3 X-500 I-500\n", "fanuc");
    const Motions& m = p.motions;
    ASSERT_GT(m.size(), 500);
    EXPECT_EQ(m.end.back().vec(), Vec3(-1000, 0, 0));
    for (std::int64_t i = 2; i < m.size(); ++i) {
        const Vec3 a = m.begin_of(i).vec();
        const Vec3 b = m.end[static_cast<std::size_t>(i)].vec();
        EXPECT_NEAR(std::hypot(b.x() / 2, b.y()), 500, 1e-9);
        // The ellipse's point halfway between the angles of the ends, compared with the chord.
        const double t = 0.5 * (std::atan2(a.y(), a.x() / 2) + std::atan2(b.y(), b.x() / 2));
        const Vec3 displacement = (b - a).normalized();
        const Vec3 off = Vec3(1000 * std::cos(t), 500 * std::sin(t), 0) - a;
        EXPECT_LT((off - off.dot(displacement) * displacement).norm(), 1e-3);
    }
}

TEST(FanucFrame, MirrorsThenScalesThenTurnsInItsLocalZero) {
    // (1, 0) → mirrored (−1, 0) → scaled (−2, 0) → turned (0, −2) → local zero (10, 18).
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG52 X10 Y20\nG51.1 X0\nG51 X0 Y0 P2\nG68 X0 Y0 R90\nG1 F60 X1 Y0\n"),
              (Rows{"rapid 0 0 0", "feed 10 18 0"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG52 X10\nG1 F60 X1\nG52 X0\nX1\n"),
              (Rows{"rapid 0 0 0", "feed 11 0 0", "feed 1 0 0"}));
}

TEST(FanucPolar, CountsFromTheZeroOrFromThePosition) {
    // Bolt circle of 100 mm: 30°, 150° (the radius is modal), 270°.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG90 G16\nG0 X100 Y30\nY150\nY270\nG15 X0 Y0\n"),
              (Rows{"rapid 0 0 0", "rapid 86.6025 50 0", "rapid -86.6025 50 0", "rapid 0 -100 0", "rapid 0 0 0"}));
    // G91: 10 from the position of the tool, each angle added to the previous one.
    EXPECT_EQ(rows("G0 X5 Y0 Z0\nG16 G91\nG1 F60 X10 Y0\nX10 Y90\n"),
              (Rows{"rapid 5 0 0", "feed 15 0 0", "feed 15 10 0"}));
    // G18: Z is the radius, X the angle.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG18 G16\nG1 F60 Z10 X90\n"), (Rows{"rapid 0 0 0", "feed 10 0 0"}));
}

TEST(FanucMacro, PassesArgumentsAndKnowsVacantOnes) {
    // B is not given: vacant, so Y#2 has no effect. M is #13.
    EXPECT_EQ(rows("G0 X0 Y7 Z0\nG1 F60\nG65 P9 A3 M5\nM30\nO9\nIF [#2 NE #0] GOTO 5\nX#1 Y#2 Z#13\nN5 M99\n"),
              (Rows{"rapid 0 7 0", "feed 3 7 5"}));
    // Specification II: the second I is #7, its K #9.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG1 F60\nG65 P9 I1 J2 K3 I4 K6\nM30\nO9\nX#4 Y#7 Z#9\nM99\n"),
              (Rows{"rapid 0 0 0", "feed 1 4 6"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG65 P9 I1 J2 K3\nM30\nO9\nX#4 Y#5 Z#6\nM99\n"), (Rows{"rapid 0 0 0", "rapid 1 2 3"}));
    // I twice and thrice: #4, #7 and #10.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG65 P9 I1. I2. I3.\nM30\nO9\nX#4 Y#7 Z#10\nM99\n"),
              (Rows{"rapid 0 0 0", "rapid 1 2 3"}));
    // The manual's own example: I4. and D5. are both #7, the later one counts.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG65 A1. B2. I-3. I4. D5. P9\nM30\nO9\nX#2 Y#4 Z#7\nM99\n"),
              (Rows{"rapid 0 0 0", "rapid 2 -3 5"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG65 A1. B2. D5. I-3. I4. P9\nM30\nO9\nX#2 Y#4 Z#7\nM99\n"),
              (Rows{"rapid 0 0 0", "rapid 2 -3 4"}));
    // The words of G65 are arguments: F is not a feed.
    EXPECT_NEAR(parse("G1 F60 X1\nG65 P9 F600\nM30\nO9\nX2\nM99\n", "fanuc").motions.feed[1], 1, 1e-6);
}

TEST(FanucMacro, CallsModallyAfterEveryMotion) {
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nG66 P9 A2\nX1\nX2\nG67\nX3\nM30\nO9\nG1 F60 Z-#1\nG0 Z0\nM99\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "feed 1 0 -2", "rapid 1 0 0", "rapid 2 0 0", "feed 2 0 -2",
                    "rapid 2 0 0", "rapid 3 0 0"}));
}

TEST(FanucMacro, CountsAsTheManualHasIt) {
    // AND, OR and XOR work bit by bit: 5 is 101, 3 is 011.
    EXPECT_EQ(rows("G0 X[5 AND 3] Y[5 OR 3] Z[5 XOR 3]\n"), (Rows{"rapid 1 7 6"}));
    EXPECT_EQ(rows("#1=4\nIF[[#1 GT 3] AND [#1 LE 5]]GOTO 1\nG0 X9 Y9 Z9\nN1 G0 X1 Y1 Z1\n"), (Rows{"rapid 1 1 1"}));
    // FIX truncates, FUP rounds up, both by magnitude.
    EXPECT_EQ(rows("#1=FIX[-1.2]\n#2=FUP[-1.2]\n#3=FUP[1.2]\nG0 X#1 Y#2 Z#3\n"), (Rows{"rapid -1 -2 2"}));
    // ROUND rounds to whole numbers; in a word to the least increment: 0.001 mm, 0.0001 in.
    EXPECT_EQ(rows("#1=ROUND[2.5]\nG0 X#1 Y[ROUND[1.2345]+ROUND[2.3456]] Z0\n"), (Rows{"rapid 3 3.581 0"}));
    EXPECT_EQ(rows("G20\nG0 X0 Y0 Z[ROUND[1.00004]]\n"), (Rows{"rapid 0 0 25.4"}));
    // Digits of four bits each: 12 is 0001'0010, which is 18. 2 to the power of 3.
    EXPECT_EQ(rows("G0 X[BCD[12]] Y[BIN[18]] Z[POW[2,3]]\n"), (Rows{"rapid 18 12 8"}));
    EXPECT_NE(error_of("#1=BIN[-1]\n", "fanuc").find("BIN of -1"), std::string::npos);
}

TEST(FanucMacro, JumpsLoopsAndReturnsToABlock) {
    EXPECT_EQ(rows("G0 X0 Y0 Z0\n#100=30\nGOTO #100\nX9\nN30 X1\nM98 P20007\nX9\nN50 X2\nM30\nO7\nG91 Y1\nG90 M99\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 1 1 0", "rapid 1 2 0", "rapid 9 2 0", "rapid 2 2 0"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z0\nM98 P7 L1\nX9\nN50 X2\nM30\nO7\nX5\nM99 P50\n"),
              (Rows{"rapid 0 0 0", "rapid 5 0 0", "rapid 2 0 0"}));
    // In the main program M99 P is a jump, forward and back.
    EXPECT_EQ(rows("G0 X0 Y0 Z0\n#1=0\nN10 #1=#1+1\nX#1\nIF [#1 GE 2] GOTO 20\nM99 P10\nN20 M99 P30\nX77\n"
                   "N30 Y5\nM30\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 2 0 0", "rapid 2 5 0"}));
    EXPECT_NE(error_of("G0 X0 Y0 Z0\nM99 P7\n", "fanuc").find("there is no block N7"), std::string::npos);
    EXPECT_EQ(rows("G0 X0 Y0 Z0\n#1=0\nWHILE[#1LT2]DO1\n#1=#1+1\nIF[#1EQ2]THEN #2=5\nX#1\nEND1\nX#2\n"),
              (Rows{"rapid 0 0 0", "rapid 1 0 0", "rapid 2 0 0", "rapid 5 0 0"}));
}

TEST(FanucMacro, EndsAtItsAlarmAndReportsUnknownVariables) {
    const Program p = parse("G0 X1\n#1=#3011\n#3000=1(TOO DEEP)\nX2\n", "fanuc");
    EXPECT_EQ(p.motions.size(), 1);
    EXPECT_EQ(p.diagnostics.count("program.alarm"), 1u);
    ASSERT_EQ(p.diagnostics.count("program.variable"), 1u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:2");
}

TEST(FanucOffsets, AreSetByG10AndByVariables) {
    // G55 is 5 to the right of G54 (set in both ways), G54.1 P1 10 up; the machine does not move.
    EXPECT_EQ(rows("G54 G0 X0 Y0 Z0\nG10 L2 P2 X5\nG55\nG53 X7\nG10 L20 P1 X5 Y10\nG54.1 P1\nG53 Y12\nG54 P1 X1 Y1\n"),
              (Rows{"rapid 0 0 0", "rapid 2 0 0", "rapid 2 2 0", "rapid 1 1 0"}));
    EXPECT_EQ(rows("G54 G0 X0 Y0 Z0\n#5241=5\nG55 X#5241\nG91 G10 L2 P2 X1\nG90 G53 X0\n"),
              (Rows{"rapid 0 0 0", "rapid 5 0 0", "rapid -6 0 0"}));
}

TEST(FanucCycles, CrossAtTheLevelWhereTheyAre) {
    EXPECT_EQ(rows("G0 X0 Y0 Z10\nG99 G81 X1 R2 Z-1 F60\nX2 K2\nG98 X3\nG80\n"),
              (Rows{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 2", "feed 1 0 -1", "rapid 1 0 2", "rapid 2 0 2",
                    "rapid 2 0 2", "feed 2 0 -1", "rapid 2 0 2", "rapid 2 0 2", "rapid 2 0 2", "feed 2 0 -1",
                    "rapid 2 0 2", "rapid 3 0 2", "rapid 3 0 2", "feed 3 0 -1", "rapid 3 0 10"}));
}

/// The cutting motions.
Rows cuts(const std::string& text) {
    Rows all = rows(text);
    std::erase_if(all, [](const std::string& row) { return !row.starts_with("feed"); });
    return all;
}

// A row of holes: R and Z keep the given heights.
TEST(FanucCycles, KeepTheirHeightsFromG90ToG91AndBack) {
    EXPECT_EQ(cuts("G90 G0 X0 Y0 Z10\nG99 G81 X0 Y0 Z-10. R2. F100\nG91 X10. K2\nG80\n"),
              (Rows{"feed 0 0 -10", "feed 10 0 -10", "feed 20 0 -10"}));
    EXPECT_EQ(rows("G90 G0 X0 Y0 Z10\nG99 G81 X0 Y0 Z-10. R2. F100\nG91 X10. K2\nG80\n")[5], "rapid 10 0 2");
    // From 10: R at 2, the bottom 12 below it.
    EXPECT_EQ(cuts("G90 G0 X0 Y0 Z10\nG91 G99 G81 X5 Z-12 R-8 F100\nG90 X20\nG80\n"),
              (Rows{"feed 5 0 -10", "feed 20 0 -10"}));
}

// The bolt circle of Fanuc's manual: the angles 30°, then two increments of 120° about the same pole.
TEST(FanucPolar, AnAngleAloneTurnsAboutTheSamePole) {
    EXPECT_EQ(cuts("G90 G0 X0 Y0 Z0\nG17 G90 G16\nG81 X100. Y30. Z-20. R-5. F200.\nG91 Y120.\nG91 Y120.\nG15 G80\n"),
              (Rows{"feed 86.6025 50 -20", "feed -86.6025 50 -20", "feed 0 -100 -20"}));
}

TEST(FanucCycles, KeepTheirWordsUntilTheyEnd) {
    // Another cycle goes on with R, Z and P, G80 and G1 end them.
    EXPECT_EQ(rows("G0 X0 Y0 Z5\nG99 G82 X1. Y1. Z-1. R1. P500 F50\nG85 X2.\nG89 X3. Z-2.\nG80\n"),
              (Rows{"rapid 0 0 5", "rapid 1 1 5", "rapid 1 1 1", "feed 1 1 -1", "dwell 1 1 -1", "rapid 1 1 1",
                    "rapid 2 1 1", "rapid 2 1 1", "feed 2 1 -1", "feed 2 1 1", "rapid 3 1 1", "rapid 3 1 1",
                    "feed 3 1 -2", "dwell 3 1 -2", "feed 3 1 1"}));
    EXPECT_EQ(cuts("G0 X0 Y0 Z5\nG99 G83 X1 Z-4 R0 Q3 F50\nG73 X2\nG80\n"),
              (Rows{"feed 1 0 -3", "feed 1 0 -4", "feed 2 0 -3", "feed 2 0 -4"}));
    EXPECT_EQ(parse("G0 X0 Y0 Z5\nG81 X1 Z-1 R1 F50\nG82 X2\nG80\n", "fanuc").diagnostics.count("program.cycle"), 0u);
    const Program p = parse("G0 X0 Y0 Z5\nG81 X1 Z-1 R1 F50\nG80\nG81 X2 R3\nX3\nG80\n", "fanuc");
    EXPECT_EQ(motions(p)[7], "feed 2 0 0");
    ASSERT_EQ(p.diagnostics.count("program.cycle"), 1u);
    EXPECT_EQ(p.diagnostics.kept()[0].text, "G81 without Z: read as Z0");
}

TEST(FanucCycles, BoreFineAndFromBehind) {
    // G76: sideways by Q along X, out, back. G87: sideways, to R below, back, up to Z.
    EXPECT_EQ(rows("G0 X0 Y0 Z10\nG98 G76 X1 R2 Z-5 Q0.5 F60\n"),
              (Rows{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 2", "feed 1 0 -5", "rapid 1.5 0 -5", "rapid 1.5 0 10",
                    "rapid 1 0 10"}));
    EXPECT_EQ(rows("G0 X0 Y0 Z10\nG98 G87 X1 R-8 Z-5 Q0.5 F60\n"),
              (Rows{"rapid 0 0 10", "rapid 1 0 10", "rapid 1.5 0 10", "rapid 1.5 0 -8", "rapid 1 0 -8", "feed 1 0 -5",
                    "rapid 1.5 0 -5", "rapid 1.5 0 10", "rapid 1 0 10"}));
}

TEST(FanucCycles, TapWithDwellInMilliseconds) {
    const Program p = parse("G0 X0 Y0 Z10\nG99 G84 R2 Z-5 P500 F60\n", "fanuc");
    EXPECT_EQ(motions(p),
              (Rows{"rapid 0 0 10", "rapid 0 0 10", "rapid 0 0 2", "feed 0 0 -5", "dwell 0 0 -5", "feed 0 0 2"}));
    EXPECT_FLOAT_EQ(p.motions.feed[4], 0.5F);
}

TEST(FanucTools, GiveLengthsAndRadii) {
    // The end of the tool moves to Z; until a Z word comes, the length shows.
    EXPECT_EQ(motions(parse_with_tool("G54 G0 X0 Y0 Z100\nG43 H1\nX1\nZ20\nG49 X2\n", "fanuc")),
              (Rows{"rapid 0 0 100", "rapid 1 0 50", "rapid 1 0 20", "rapid 2 0 70"}));
    // Radius 2 to the left of +Y: the entry ends at X 8, offset from the beginning of the cut, not from its own path.
    EXPECT_EQ(motions(parse_with_tool("G0 X0 Y0 Z0\nG41 D1 G1 X10 F60\nY20\nX30\nG40 X40\n", "fanuc")),
              (Rows{"rapid 0 0 0", "feed 8 0 0", "feed 8 20 0", "cw 10 22 0", "feed 30 22 0", "feed 40 20 0"}));
    const Program none = parse("G41 D1 G1 X10 F60\n", "fanuc");
    EXPECT_EQ(none.diagnostics.count("program.cutter-compensation"), 1u);
}

TEST(FanucBlocks, NameWordsThatAStraightMotionDoesNotUse) {
    // A corner without its comma, a centre without its G2; M and H words are specific to the machine.
    const Program p =
        parse("G0 X0 Y0 Z0\nG1 X10 R5 F60\nX20 I5\nX30 M3 P2\nX40 H1\nM98 P9 L2\nM30\nO9\nX50\nM99\n", "fanuc");
    ASSERT_EQ(p.diagnostics.count("program.unused-word"), 2u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:2:8");
    EXPECT_EQ(p.diagnostics.kept()[1].where.text(), "test.nc:3:5");
    EXPECT_EQ(p.motions.size(), 7);
}

TEST(FanucModes, AreNotedAndTheRestReported) {
    const Program p = parse("G5.1 Q1 R1\nG08 P1\nG0 X1 Y0 Z0\nG187 P1\nG68.3 X0 Y0 Z0 R0\nX5 ,R2\n", "fanuc");
    EXPECT_EQ(p.events.at(0).name, "high-speed");
    EXPECT_EQ(p.diagnostics.count("program.rotation"), 1u);
    EXPECT_EQ(p.diagnostics.count("program.unknown-word"), 2u);  // G187, ,R2
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:4:1");
}

/// The tool axis of a motion, if the program determines it: "x y z".
std::string axis_of(const Program& p, std::size_t motion) {
    if (p.motions.tool_axis.empty()) return "none";
    const Vec3 a = p.motions.tool_axis[motion].vec();
    return a.array().isNaN().any() ? "none"
                                   : fmt::format("{:.4f} {:.4f} {:.4f}", a.x() + 0.0, a.y() + 0.0, a.z() + 0.0);
}

TEST(FanucTiltedPlanes, AreEulerAnglesOrTurnsAboutTheWorkAxes) {
    // I 90: x' = y. J 90 about x': z' = x. So (1, 2, 3) of the plane is y 1, z 2, x 3, shifted by (10, 20, 30).
    Program p = parse("G0 X0 Y0 Z0\nG68.2 X10 Y20 Z30 I90 J90 K0\nG53.1\nG1 X1 Y2 Z3 F60\nG69\nG0 X0 Y0 Z0\n", "fanuc");
    EXPECT_EQ(p.diagnostics.count("program.rotation"), 0u);
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "rapid 0 0 0", "feed 13 21 32", "rapid 0 0 0"}));
    EXPECT_EQ(axis_of(p, 0), "none");
    EXPECT_EQ(axis_of(p, 1), "1.0000 0.0000 0.0000");
    EXPECT_EQ(axis_of(p, 2), "1.0000 0.0000 0.0000");
    EXPECT_EQ(axis_of(p, 3), "none");
    // K rotates in the plane: the same normal.
    EXPECT_EQ(axis_of(parse("G0 X0 Y0 Z0\nG68.2 X0 Y0 Z0 I90 J90 K37\nG53.1\n", "fanuc"), 1), "1.0000 0.0000 0.0000");
    // P1: about the work axes, X first: by 90° (y → z, z → −y), then Y by 90° (x → −z, z → x): normal −y stays −y. Y
    // first: z → x, which X does not change.
    EXPECT_EQ(axis_of(parse("G0 X0 Y0 Z0\nG68.2 P1 Q123 X0 Y0 Z0 I90 J90 K0\nG53.1\n", "fanuc"), 1),
              "0.0000 -1.0000 0.0000");
    EXPECT_EQ(axis_of(parse("G0 X0 Y0 Z0\nG68.2 P1 Q213 X0 Y0 Z0 I90 J90 K0\nG53.1\n", "fanuc"), 1),
              "1.0000 0.0000 0.0000");
    // Inches; arcs in a vertical plane are arcs about its normal.
    p = parse("G20 G0 X0 Y0 Z0\nG68.2 X1 Y0 Z0 I0 J90 K0\nG53.1\nG1 X0 Y0 Z0 F60\nG2 X1 Y0 R0.5\n", "fanuc");
    EXPECT_EQ(p.motions.arcs.at(0).axis, 1);
}

TEST(FanucTiltedPlanes, NameWhatTheyCannotDo) {
    for (const char* text : {"G68.2 P2 Q0 X0 Y0 Z0 R0\n", "G68.2 P3 Q1 I1 J0 K0\n", "G68.2 P4 I10 J10 K0\n",
                             "G68.3 X0 Y0 Z0\n", "G68.4 X0 Y0 Z0 I0 J10 K0\n", "G18 G68.2 I0 J10 K0\n"}) {
        const Program p = parse(std::string("G0 X1 Y1 Z1\n") + text, "fanuc");
        EXPECT_EQ(p.diagnostics.count("program.rotation"), 1u) << text;
        EXPECT_EQ(p.diagnostics.kept()[0].where.number, 2u) << text;
        EXPECT_GT(p.diagnostics.kept()[0].where.column, 0u) << text;
    }
    EXPECT_EQ(parse("G53.1\nG0 X1\n", "fanuc").diagnostics.count("program.rotation"), 1u) << "no plane";
    EXPECT_NE(error_of("G68.2 P1 Q113 I1 J1 K1\n", "fanuc").find("Q113 is not a permutation"), std::string::npos);
    EXPECT_NE(error_of("G0 X0 Y0 Z0\nG68.2 I0 J30 K0\nG53.1\nG91 A5\n", "fanuc")
                  .find("test.nc:4:5: error: an increment of A"),
              std::string::npos);
}

TEST(FanucBlocks, AreSkippedAtEveryLevel) {
    EXPECT_EQ(rows("G0 X1 Y0 Z0\n/X2\n/3 X3\nN5 /9 X4\n"), (Rows{"rapid 1 0 0"}));
}

TEST(Programs, TellOfMissingFeedsEndsAndAxes) {
    const Program p = parse("G1 X1\nG0 X2 U0\n", "fanuc");
    EXPECT_EQ(p.diagnostics.count("program.no-feed"), 1u);
    EXPECT_EQ(p.diagnostics.count("program.no-end"), 1u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:1");
    // An axis other than X Y Z: while it stays at 0 everything is known; if it moves, the tool is elsewhere.
    EXPECT_EQ(p.diagnostics.count("program.axis"), 0u);
    for (const char* dialect : {"fanuc", "siemens"}) {
        EXPECT_TRUE(
            error_of("G0 X1 Y0 Z0\nG1 X2 V-0.5 F100\n", dialect)
                .starts_with("test.nc:2:7: error: axis V moves: where the tool is with axes U V W is not known"))
            << dialect;
    }
    EXPECT_EQ(parse("G0 X1 Y0 Z0\nG1 X2 V-0.5 F100\n", "linuxcnc").diagnostics.count("program.axis"), 1u);
    EXPECT_EQ(parse("G1 X1 F1\nM30\n", "fanuc").diagnostics.count("program.no-end"), 0u);
}

}  // namespace
}  // namespace clsurf::fanuc_test
