// Rules of RS274 as in LinuxCNC; the expected values are computed by hand next to each program.

#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::rs274_test {
namespace {

std::string inside_comp(const std::string& path) { return "G41.1 D4\nG1 F60 X10\nX20\n" + path + "G40\nG1 X50\n"; }

TEST(CutterCompensation, GoesAroundAnOutsideCornerAndComesBackToTheProgrammedPath) {
    // Radius 2 on the right: below the first line, then a quarter circle about (20, 0), then offset from X 20.
    const Program p = parse("G42.1 D4\nG1 F60 X10\nX20\nY10\nG40\nG1 X50\n", "linuxcnc");
    EXPECT_EQ(motions(p), (Rows{"feed 10 -2 0", "feed 20 -2 0", "ccw 22 0 0", "feed 22 10 0", "feed 50 10 0"}));
    ASSERT_EQ(p.motions.arcs.size(), 1u);
    EXPECT_DOUBLE_EQ(p.motions.arcs[0].centre.x, 20.0);
}

TEST(CutterCompensation, CutsAnInsideCornerShort) {
    // A right angle to the left: both lines end and begin at (18, 2). A plunge in the corner moves with it.
    EXPECT_EQ(motions(parse(inside_comp("Z-1\nY10\n"), "linuxcnc")),
              (Rows{"feed 10 2 0", "feed 18 2 0", "feed 18 2 -1", "feed 18 10 -1", "feed 50 10 -1"}));
}

TEST(CutterCompensation, KeepsBesideArcs) {
    // Outside a half circle of radius 3 the tool's centre runs on radius 5, which Y 2 meets at 23 ± √21;
    // inside one it runs on radius 1, after turning about both of its ends.
    EXPECT_EQ(motions(parse(inside_comp("G2 X26 I3\nG1 X30\n"), "linuxcnc")),
              (Rows{"feed 10 2 0", "feed 18.4174 2 0", "cw 27.5826 2 0", "feed 30 2 0", "feed 50 0 0"}));
    EXPECT_EQ(
        motions(parse(inside_comp("G3 X26 I3\nG1 X30\n"), "linuxcnc")),
        (Rows{"feed 10 2 0", "feed 20 2 0", "cw 22 0 0", "ccw 24 0 0", "cw 26 2 0", "feed 30 2 0", "feed 50 0 0"}));
}

TEST(CutterCompensation, JoinsArcsWhereTheirTracksCross) {
    // Radii 3 and 7 become 5 and 9 about (23, 0) and (33, 0): 10 apart, they intersect 2.2 on, √20.16 up.
    EXPECT_EQ(motions(parse(inside_comp("G2 X26 I3\nG2 X40 I7\nG1 Y-5\n"), "linuxcnc")),
              (Rows{"feed 10 2 0", "feed 18.4174 2 0", "cw 25.2 4.49 0", "cw 42 0 0", "feed 42 -5 0", "feed 50 -5 0"}));
}

TEST(CutterCompensation, EntersByAnArcThatEndsTangent) {
    // To (8, 10), offset from the end, with its centre on Y 10 at the same distance from the origin: −2.25.
    const Program p = parse("G41.1 D4\nG3 F60 X10 Y10 J10\nG1 Y20\nG40\n", "linuxcnc");
    EXPECT_EQ(motions(p), (Rows{"ccw 8 10 0", "feed 8 20 0"}));
    EXPECT_DOUBLE_EQ(p.motions.arcs[0].centre.x, -2.25);
}

TEST(CutterCompensation, WorksInTheLathesPlane) {
    // G18 rotates from Z to X: right of +X is +Z.
    EXPECT_EQ(motions(parse("G18 G42.1 D4\nG1 F60 X10\nX20\n", "linuxcnc")), (Rows{"feed 10 0 2", "feed 20 0 2"}));
}

TEST(CutterCompensation, SaysWhyATooLargeToolCannotGoThere) {
    EXPECT_NE(error_of(inside_comp("X0 Y4\n"), "linuxcnc").find("the tool would gouge"), std::string::npos);
    EXPECT_NE(error_of("G41.1 D4\nG1 F60 X1\n", "linuxcnc").find("must be longer than the tool's radius"),
              std::string::npos);
    EXPECT_NE(error_of(inside_comp("G3 X22 I1\n"), "linuxcnc").find("does not fit into an arc of radius 1.0000 mm"),
              std::string::npos);
    EXPECT_NE(error_of("G41.1\n", "linuxcnc").find("needs the tool's diameter (D)"), std::string::npos);
    EXPECT_NE(error_of(inside_comp("G41.1 D4\n"), "linuxcnc").find("is on already"), std::string::npos);
    EXPECT_NE(error_of(inside_comp("G28\n"), "linuxcnc").find("G28 cannot be used while cutter compensation is on"),
              std::string::npos);
    EXPECT_NE(error_of(inside_comp("X30\nG40\nG2 X32 I1\n"), "linuxcnc").find("must be a straight one"),
              std::string::npos);
    EXPECT_NE(error_of("G19 G41.1 D4\n", "linuxcnc").find("needs the XY or the XZ plane"), std::string::npos);
}

TEST(ToolTable, IsThatOfTheStandAloneInterpreter) {
    // T1: 0.511 inch long, 0.125 inch wide. Its length is subtracted if no word sets Z.
    EXPECT_EQ(motions(parse("T1 M6\nG43\nG0 X1\nG41\nG1 F60 X10\n", "linuxcnc")),
              (Rows{"rapid 1 0 -12.9794", "feed 10 1.5875 -12.9794"}));
    // In the block of the change the position does not change; G43.2 adds, G43.1 sets, G49 ends.
    EXPECT_EQ(motions(parse("T2 M6 G43\nG0 X1\nG43.2 H1\nG0 X2\nG43.1 Z1\nG0 X3\nG49\nG0 X4\n", "linuxcnc")),
              (Rows{"rapid 1 0 0", "rapid 2 0 -12.9794", "rapid 3 0 1.54", "rapid 4 0 2.54"}));
    // G10 L1 sets, L10 sets the present position: 5 with offset −5.
    EXPECT_EQ(motions(parse("T1 M6\nG10 L1 P1 Z2\nG43 G0 X1\nG10 L10 P1 Z5\nG43 G0 X[#5403*25.4]\n", "linuxcnc")),
              (Rows{"rapid 1 0 -2", "rapid -5 0 5"}));
}

TEST(ToolTable, OfTheUserComesFirst) {
    const auto text = std::make_shared<std::string>("T7 M6\nG43\nG0 X1\nT9 M6\n");
    InterpreterOptions options;
    options.dialect = find_dialect("linuxcnc");
    options.tools.emplace();
    options.tools->tools[7] = Tool{.number = 7, .offset = Vec3(0, 0, 10)};
    const Program p = parse_program(SourceText("test.nc", *text, text), options);
    EXPECT_EQ(motions(p), (Rows{"rapid 1 0 -10"}));
    EXPECT_EQ(p.diagnostics.count("program.tool-table"), 1u);  // T9
}

TEST(Cycles, CountIncrementsFromWhereTheyBegan) {
    // From 10: R 8, bottom 7; after two holes R -3 still counts from 10.
    EXPECT_EQ(
        motions(parse("G0 Z10\nG91 G99 G81 X1 Z-1 R-2 F60 L2\nX2 R-3\n", "linuxcnc")),
        (Rows{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 8", "feed 1 0 7", "rapid 1 0 8", "rapid 2 0 8", "rapid 2 0 8",
              "feed 2 0 7", "rapid 2 0 8", "rapid 4 0 8", "rapid 4 0 7", "feed 4 0 6", "rapid 4 0 7"}));
}

TEST(Cycles, BoreFromBelow) {
    EXPECT_EQ(motions(parse("G98 G0 Z3\nG87 X3 Z-1 R1 I1 J1 K0.5 F60\n", "linuxcnc")),
              (Rows{"rapid 0 0 3", "rapid 3 0 3", "rapid 3 0 1", "rapid 4 1 1", "rapid 4 1 -1", "rapid 3 0 -1",
                    "feed 3 0 0.5", "feed 3 0 -1", "rapid 4 1 -1", "rapid 4 1 3", "rapid 3 0 3"}));
}

TEST(Cycles, LeaveABoreWithFeedToR) {
    EXPECT_EQ(motions(parse("G98 G0 Z5\nG85 Z-2 R1 F60\nG89 Z-2 R1 P0\n", "linuxcnc")),
              (Rows{"rapid 0 0 5", "rapid 0 0 5", "rapid 0 0 1", "feed 0 0 -2", "feed 0 0 1", "rapid 0 0 5",
                    "rapid 0 0 5", "rapid 0 0 1", "feed 0 0 -2", "dwell 0 0 -2", "feed 0 0 5"}));
}

TEST(Cycles, CutThreadsInPasses) {
    // Crest at X 9, cuts at 8.4 and 8; retracted to crest plus depth, 2; both tapers rise by 1 over 0.5.
    EXPECT_EQ(motions(parse("G18 G0 X10 Z5\nS100 M3\nG76 P1 Z-10 I-1 J0.6 K1 E0.5 L3\n", "linuxcnc")),
              (Rows{"rapid 10 0 5", "rapid 10.4 0 5", "feed 9.4 0 5", "feed 8.4 0 4.5", "feed 8.4 0 -9.5",
                    "feed 9.4 0 -10", "rapid 10.4 0 -10", "rapid 10 0 5", "feed 9 0 5", "feed 8 0 4.5", "feed 8 0 -9.5",
                    "feed 9 0 -10", "rapid 10 0 -10", "rapid 10 0 -10"}));
    // R 2 keeps the chip area constant: J·√n; Q 45 shifts by the depth.
    EXPECT_EQ(motions(parse("G18 G0 X10 Z5\nS100 M3\nG76 P1 Z-10 I-1 J1 K1.2 R2 Q45\n", "linuxcnc"))[1],
              "rapid 10.2 0 4");
    EXPECT_NE(error_of("G18 G0 X10 Z5\nG76 P1 Z-10 I-1 K1\n", "linuxcnc").find("J is missing"), std::string::npos);
}

const std::string turned = "G18 G0 X50 Z6\nF60\no100 sub\nG0 X20 Z0\nG1 Z-5\nX24\nX30 Z-10\no100 endsub\n";

TEST(LatheCycles, RoughAlongZFromTheStartToTheProfile) {
    // Cuts at X 32, 28, 24, each from the line between the start and the beginning of the profile, retracted by R
    // at 45°; then the profile, and out to X 32.
    EXPECT_EQ(motions(parse(turned + "G71 Q100 X32 Z3 I4 R1\n", "linuxcnc")),
              (Rows{"rapid 50 0 6",       "rapid 32 0 3",  "rapid 32 0 3", "rapid 32 0 3", "feed 32 0 -10",
                    "rapid 33 0 -9",      "rapid 33 0 2",  "rapid 32 0 3", "rapid 28 0 2", "feed 28 0 -8.3333",
                    "rapid 29 0 -7.3333", "rapid 29 0 1",  "rapid 28 0 2", "rapid 24 0 1", "feed 24 0 -5",
                    "rapid 25 0 -4",      "rapid 25 0 0",  "rapid 24 0 1", "rapid 20 0 0", "feed 20 0 -5",
                    "feed 24 0 -5",       "feed 30 0 -10", "feed 32 0 -10"}));
}

TEST(LatheCycles, FinishInPassesBesideTheProfile) {
    // D 1 in two passes: half a millimetre off, inside corner at (20.5, -4.5), then the profile itself.
    const std::vector<std::string> all = motions(parse(turned + "G70 Q100 X32 Z3 D1 P2\n", "linuxcnc"));
    ASSERT_EQ(all.size(), 13u);
    EXPECT_EQ(Rows(all.begin() + 1, all.begin() + 5),
              (Rows{"rapid 32 0 3", "rapid 32 0 3", "rapid 20.5 0 0", "feed 20.5 0 -4.5"}));
    EXPECT_EQ(Rows(all.end() - 4, all.end()), (Rows{"rapid 20 0 0", "feed 20 0 -5", "feed 24 0 -5", "feed 30 0 -10"}));
}

// The motions of the profile are removed again, with their frames.
TEST(LatheCycles, MotionsAfterACycleHaveTheirOwnFrame) {
    const Program p =
        parse(turned + "G54 G0 X50 Z6\nG55 G0 X40 Z6\nG71 Q100 X32 Z3 I4 R1\nG54 G0 X50 Z6\nG55 G0 X40\n", "linuxcnc");
    const Motions& m = p.motions;
    const std::int64_t last = m.size() - 1;
    EXPECT_EQ(m.frame_of(1).system, 1);
    EXPECT_EQ(m.frame_of(2).system, 2);
    EXPECT_EQ(m.frame_of(last - 2).system, 2) << "of the cycle";
    EXPECT_EQ(m.frame_of(last - 1).system, 1);
    EXPECT_EQ(m.frame_of(last).system, 2);
    EXPECT_EQ(m.frame.size(), m.kind.size());
}

TEST(LatheCycles, SayWhatTheyDoNotCut) {
    const Program p =
        parse("G18 F60\no1 sub\nG0 X20 Z0\nG1 Z-5\nX18\nZ-10\nX30\no1 endsub\nG71 Q1 X32 Z2 I1\n", "linuxcnc");
    EXPECT_EQ(p.diagnostics.count("program.cycle"), 1u);
    EXPECT_EQ(p.motions.size(), 0);
    EXPECT_NE(error_of("G18 F60\nG71 Q9 X1 Z1 I1\n", "linuxcnc").find("subprogram '9' is neither"), std::string::npos);
}

TEST(Probing, IsAMotionToTheProgrammedPoint) {
    // The probe touches there, as #5061 … show: the next motion begins there and is level.
    const Program p = parse("G64 P0.1\nG38.2 Z-2 F120\nG0 X#5063\nG0 Z#5070\n", "linuxcnc");
    EXPECT_EQ(motions(p), (Rows{"feed 0 0 -2", "rapid -2 0 -2", "rapid -2 0 0"}));
    EXPECT_FLOAT_EQ(p.motions.feed[0], 2);
    EXPECT_EQ(p.motions.line[0], 2U);
    // The probe stops; after that, corners are rounded again.
    std::vector<std::pair<std::int64_t, BlockEnd>> modes;
    for (const ProgramEvent& e : p.events) {
        if (e.path_mode()) modes.emplace_back(e.motion, e.path_mode()->block_end);
    }
    EXPECT_EQ(modes, (decltype(modes){{0, BlockEnd::rounded}, {0, BlockEnd::exact_stop}, {1, BlockEnd::rounded}}));
}

// rs274 does not change the rate if the unit changes: 100 in/min remain 2540 mm/min.
TEST(Feeds, KeepTheUnitThatTheyWereReadIn) {
    const Program p = parse("G20 G0 X0 Y0 Z0\nF100\nG1 X1\nG21\nX0\nM70\nF100\nX10\nG20 X1\nM72\nG1 X0\n", "linuxcnc");
    ASSERT_EQ(p.motions.size(), 6);
    EXPECT_NEAR(p.motions.feed[1] * 60, 2540, 1e-3);
    EXPECT_NEAR(p.motions.feed[2] * 60, 2540, 1e-3);
    EXPECT_NEAR(p.motions.feed[3] * 60, 100, 1e-4);
    EXPECT_NEAR(p.motions.feed[4] * 60, 100, 1e-4);
    EXPECT_NEAR(p.motions.feed[5] * 60, 2540, 1e-3);
    // Fanuc interprets the active F in the new unit.
    EXPECT_NEAR(parse("G20 G0 X0 Y0 Z0\nF100\nG1 X1\nG21\nX0\n", "fanuc").motions.feed[2] * 60, 100, 1e-4);
}

TEST(Modes, AreKeptAndComeBack) {
    EXPECT_EQ(motions(parse("M70\nG20 G91\nM72\nG0 X1\nX1\n", "linuxcnc")), (Rows{"rapid 1 0 0", "rapid 1 0 0"}));
    EXPECT_EQ(motions(parse("o1 sub\nM73\nG20 G0 X1\no1 endsub\no1 call\nG0 X1\n", "linuxcnc")),
              (Rows{"rapid 25.4 0 0", "rapid 1 0 0"}));
}

TEST(Offsets, MoveRotaryAxesToo) {
    const Program p = parse("G0 A5\nG92 A7\nG0 A9\nG10 L2 P1 A4\nG0 X1\n", "linuxcnc");
    // 9 reads 5 after the zero moved by 4.
    EXPECT_NEAR(p.motions.rotary[1].x * 180 / 3.14159265358979, 9, 1e-9);
    EXPECT_NEAR(p.motions.rotary[2].x * 180 / 3.14159265358979, 5, 1e-9);
}

TEST(Parameters, TellModesByName) {
    EXPECT_EQ(motions(parse("G91 G1 F60 X3 Y4\nG90\nG0 X[#<_x>+#<_metric>] Y[#<_motion_mode>] Z[EXISTS[#<_nothing>]]\n",
                            "linuxcnc")),
              (Rows{"feed 3 4 0", "rapid 4 10 0"}));
}

TEST(Expressions, OrderExactlyAndEqualWithATolerance) {
    EXPECT_EQ(motions(parse("#1=0.00000001\nG0 X[#1 GT 0] Y[#1 EQ 0] Z[1 LE 1]\n", "linuxcnc")), (Rows{"rapid 1 1 1"}));
}

TEST(PolarWords, NeedAnAngleAndTheirPlane) {
    EXPECT_NE(error_of("G91 G1 F60 @5\n", "linuxcnc").find("the angle is not known"), std::string::npos);
    EXPECT_NE(error_of("G1 F60 X1 ^5\n", "linuxcnc").find("combined with X or Y"), std::string::npos);
}

TEST(Rs274, M98CallsAProgramNumberAsOftenAsLSays) {
    // As in rs274: L0 calls nothing, five digits are an ordinary number.
    EXPECT_EQ(
        motions(parse("G91\nM98 P1 L2\nM98 P1 L0\nM98 P12345\nM30\nO1\nG0 X1\nM99\nO12345\nG0 Y1\nM99\n", "linuxcnc")),
        (Rows{"rapid 1 0 0", "rapid 2 0 0", "rapid 2 1 0"}));
}

TEST(Rs274, BreakAndContinueNameTheirLoop) {
    // rs274 2.9 lists these motions: the outer loop is left from inside the inner one.
    EXPECT_EQ(motions(parse("G0 X0 Y0 Z0\n#1=0\no1 while [#1 LT 5]\n#1=[#1+1]\n#2=0\no2 while [#2 LT 3]\n#2=[#2+1]\n"
                            "o3 if [#2 EQ 2]\no2 continue\no3 endif\no4 if [#1 EQ 3]\no1 break\no4 endif\n"
                            "G0 X#1 Y#2\no2 endwhile\no1 endwhile\nG0 Z1\n",
                            "linuxcnc")),
              (Rows{"rapid 0 0 0", "rapid 1 1 0", "rapid 1 3 0", "rapid 2 1 0", "rapid 2 3 0", "rapid 2 3 1"}));
    EXPECT_NE(error_of("o1 repeat [2]\no1 endrepeat\no1 break\n", "linuxcnc").find("outside a loop"),
              std::string::npos);
}

TEST(Rs274, EveryNumberedParameterExists) {
    EXPECT_EQ(motions(parse("#1=2\n#2=99999\nG0 X EXISTS[#77] Y EXISTS[##1] Z EXISTS[##2]\n", "linuxcnc")),
              (Rows{"rapid 1 1 0"}));
}

TEST(Rs274, TappingOutsideTheXYPlaneGoesWhereLinuxCncTakesIt) {
    // rs274 2.9 lists these motions.
    EXPECT_EQ(motions(parse("G18 M3 S100\nF10\nG0 X1 Y5 Z2\nG98\nG84 X3 Z4 Y-2 R1\nG0 X0 Y0 Z0\n", "linuxcnc")),
              (Rows{"rapid 1 5 2", "rapid 3 5 4", "rapid 3 1 4", "feed -2 4 3", "feed 5 4 3", "rapid 0 0 0"}));
    EXPECT_EQ(motions(parse("G19 M3 S100\nF10\nG0 X5 Y4 Z3\nG98\nG84 Y7 Z9 X-1 R2\nG0 X0\n", "linuxcnc")),
              (Rows{"rapid 5 4 3", "rapid 5 7 9", "rapid 2 7 9", "feed 9 -1 7", "feed 9 5 7", "rapid 0 7 9"}));
}

TEST(CutterCompensation, CountsWithTheRadiusAtTheEndOfAnArc) {
    // A corner flatter than 0.05 rad between arcs, given with four digits, moves by 0.0003 in if the other radius is used.
    // rs274 2.9 ends the arc at 0.4443 0.8405.
    const Program p = parse(
        "G20\nG41.1 D-0.15\nG1 X0.6767 Y0.2334 F8\nX0.3359 Y0.4419\nG3 X1.2281 Y1.3456 I0.2921 J0.6039\n"
        "G2 X0.1253 Y0.9881 I-0.6093 J0\nG3 X0.7669 Y1.4548 I0.2437 J0.3394\nG40\nG1 X1 Y0\n",
        "linuxcnc");
    ASSERT_EQ(motions(p).size(), 8u);
    EXPECT_NEAR(p.motions.end[5].x / 25.4, 0.4443, 6e-5);
    EXPECT_NEAR(p.motions.end[5].y / 25.4, 0.8405, 6e-5);
}

TEST(Rs274, EachPointOfASplineHasItsOwnWeight) {
    // Order 3 with three points is a rational parabola: ((1−t)² w0 P0 + 2 t (1−t) w1 P1 + t² w2 P2) / (the weights alone).
    // At t = 0.2 with weights 1, 2, 1: (0.64 + 0.08, 0.64) / 1.32. P in the block of the first given point is the weight of
    // that point; the first control point is the position of the tool.
    const Rows second = motions(parse("F60\nG5.2 X1 Y1 P2 L3\nX2 Y0 P1\nG5.3\n", "linuxcnc"));
    EXPECT_EQ(second, (Rows{"spline 2 0 0"}));
    const auto expect_near = [](const std::string& text, double x, double y) {
        const Program p = parse(text, "linuxcnc");
        ASSERT_EQ(p.motions.curves.size(), 1u);
        EXPECT_LE((p.motions.curves[0].span->at(0.2) - Vec3(x, y, 0)).norm(), 1e-12);
    };
    expect_near("F60\nG5.2 X1 Y1 P2 L3\nX2 Y0 P1\nG5.3\n", 0.72 / 1.32, 0.64 / 1.32);
    // With weights 3, 1, 1: (0.32 + 0.08, 0.32) / 2.28. P alone is the weight of the first.
    expect_near("F60\nG5.2 P3\nX1 Y1 P1\nX2 Y0\nG5.3\n", 0.4 / 2.28, 0.32 / 2.28);
    // LinuxCNC reads an order below 3 as 3.
    expect_near("F60\nG5.2 X1 Y1 P2 L2\nX2 Y0 P1\nG5.3\n", 0.72 / 1.32, 0.64 / 1.32);
}

TEST(Rs274, SplinesRefuseWhatLinuxCncRefuses) {
    EXPECT_NE(error_of("F60\nG5.2 X1 P2\n", "linuxcnc").find("test.nc:2: error: a point of G5.2 needs both X and Y"),
              std::string::npos);
    EXPECT_NE(error_of("F60\nG5.2 X1 Y1\nP2\n", "linuxcnc").find("test.nc:3:1: error: P without X and Y"),
              std::string::npos);
    EXPECT_NE(error_of("F60\nG5.2 X1 Y1 Z2\n", "linuxcnc").find("moves only X and Y"), std::string::npos);
}

}  // namespace
}  // namespace clsurf::rs274_test
