#include "program/interpreter.h"

#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/readers/program_file.h"
#include "program/motion_rows.h"

namespace clsurf::interpreter_test {
namespace {

TEST(Interpreter, KeepsModalMotionAndAxes) {
    EXPECT_EQ(motions(parse("G0 X1 Y2 Z3\nG1 F60 X2\nY5\nG0Z9\n", "fanuc")),
              (Rows{"rapid 1 2 3", "feed 2 2 3", "feed 2 5 3", "rapid 2 5 9"}));
}

TEST(Interpreter, ConvertsInchesAndFeeds) {
    const Program p = parse("G20 G1 X1 F10\n", "fanuc");
    EXPECT_DOUBLE_EQ(p.motions.end[0].x, 25.4);
    EXPECT_NEAR(p.motions.feed[0], 254.0 / 60, 1e-4);
}

// For a line that only turns, F counts degrees, also with inches. Under G93 it takes 1/F minutes: 3 and 4 degrees are 5, and
// at F2 10 deg/min. A line without movement also has a feed: it could not be simulated otherwise.
TEST(Interpreter, CountsDegreesWhereOnlyRotaryAxesMove) {
    const Program p = parse("G20 G0 X1 Y0 Z0 A0 C0\nG1 A30 F120\nG93 A33 C4 F2\nX1 F2\nG95 M3 S60 C5 F2\n", "linuxcnc");
    ASSERT_EQ(p.motions.size(), 5);
    EXPECT_NEAR(p.motions.feed[1], 120.0 / 60, 1e-6);
    EXPECT_NEAR(p.motions.feed[2], 10.0 / 60, 1e-6);
    EXPECT_GT(p.motions.feed[3], 0);
    EXPECT_NEAR(p.motions.feed[4], 120.0 / 60, 1e-6);
    EXPECT_EQ(p.diagnostics.count("program.no-feed"), 0U);
}

TEST(Interpreter, AddsIncrementsUnderG91) {
    EXPECT_EQ(motions(parse("G0 X1 Y1 Z0\nG91 G1 F60 X1\nX1 Y-3\nG90 X0\n", "fanuc")),
              (Rows{"rapid 1 1 0", "feed 2 1 0", "feed 3 -2 0", "feed 0 -2 0"}));
}

TEST(Interpreter, ReadsTapesAsTheyCome) {
    // Byte order mark, CRLF, lower case, no blanks, N numbers, comments, block delete, percent.
    const std::string tape =
        "\xef\xbb\xbf%\r\no1000 (part)\r\nn10g90g21\r\nn20g0x.5y1.z-1\r\n/g0x99\r\nn30.5 g1f100x1 (half) y2 ; rest\r\nm30\r\n%\r\ng0x7\r\n";
    EXPECT_EQ(motions(parse(tape, "fanuc")), (Rows{"rapid 0.5 1 -1", "feed 1 2 -1"}));
}

TEST(Interpreter, CarriesRotaryAxes) {
    const Program p = parse("G1 F100 X1 A90\nC-45\n", "linuxcnc");
    EXPECT_NEAR(p.motions.rotary[1].x, std::numbers::pi / 2, 1e-12);
    EXPECT_NEAR(p.motions.rotary[1].z, -std::numbers::pi / 4, 1e-12);
}

TEST(Interpreter, ResolvesFullCirclesPlanesAndAbsoluteCentres) {
    const Program p = parse("G0 X1 Y0 Z0\nG3 F60 I-1\nG18 G2 X2 Z1 I1\nG17 G90.1 G2 X4 Y0 I3 J0\n", "linuxcnc");
    ASSERT_EQ(p.motions.arcs.size(), 3u);
    EXPECT_DOUBLE_EQ(p.motions.arcs[0].centre.x, 0.0);
    EXPECT_EQ(p.motions.arcs[1].axis, 1);
    EXPECT_DOUBLE_EQ(p.motions.arcs[1].centre.x, 2.0);
    EXPECT_DOUBLE_EQ(p.motions.arcs[2].centre.x, 3.0);
}

TEST(Interpreter, MakesAWrongArcAnErrorWithBothRadii) {
    EXPECT_EQ(
        error_of("G0 X0 Y0\nG2 X2 Y0 I1.2 J0 F60\n", "linuxcnc"),
        "test.nc:2:1: error: arc radius differs: 1.2000 at the start, 0.8000 at the end\n    G2 X2 Y0 I1.2 J0 F60\n    ^\n");
}

TEST(Interpreter, ShiftsWithG92AndWorkOffsets) {
    // G92 sets the present position to 10; G10 L2 moves the zero of G55 to machine X 5.
    EXPECT_EQ(
        motions(parse("G0 X1 Y0 Z0\nG92 X10\nG0 X11\nG92.1\nG0 X0\nG10 L2 P2 X5\nG55 G0 X0\nG53 G0 X0\n", "linuxcnc")),
        (Rows{"rapid 1 0 0", "rapid 11 0 0", "rapid 0 0 0", "rapid 0 0 0", "rapid -5 0 0"}));
}

TEST(Interpreter, ReturnsToKeptReferencePoints) {
    // G92 shifts X by 4, after both points are kept: machine X 1 is −3, X 4 is 0. Each return first moves through the
    // present position. The parameters count inches (stand_alone_tools).
    EXPECT_EQ(motions(parse("G0 X1 Y2 Z3 A10\nG28.1\nG0 X4 Y5 Z6 A20\nG30.1\nG92 X0\nG28\nG30\n"
                            "G0 X[25.4*#5161] Y#5164 Z[25.4*#5211]\nG0 X[25.4*#5181] Y#5184\n",
                            "linuxcnc")),
              (Rows{"rapid 1 2 3", "rapid 4 5 6", "rapid 0 5 6", "rapid -3 2 3", "rapid -3 2 3", "rapid 0 5 6",
                    "rapid 1 10 4", "rapid 4 20 4"}));
}

TEST(Interpreter, RunsCannedCyclesAsMotions) {
    // G83, Q 2 from R 1 to Z −3: pecks at −1 and −3, retraction to R in between, then to 0.254 mm above the last depth.
    EXPECT_EQ(motions(parse("G0 X0 Y0 Z5\nG98 G83 X1 Y2 Z-3 R1 Q2 F60\nG80\n", "linuxcnc")),
              (Rows{"rapid 0 0 5", "rapid 1 2 5", "rapid 1 2 1", "feed 1 2 -1", "rapid 1 2 1", "rapid 1 2 -0.746",
                    "feed 1 2 -3", "rapid 1 2 5"}));
}

TEST(Interpreter, ReturnsToTheLevelWhereACycleBegan) {
    // G98 after G99: out to Z 10, where the first of the cycles began, and across at that height.
    EXPECT_EQ(motions(parse("G0 X0 Y0 Z10\nG99 G81 X1 Z-1 R2 F60\nG98 X2\n", "linuxcnc")),
              (Rows{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 2", "feed 1 0 -1", "rapid 1 0 2", "rapid 2 0 10",
                    "rapid 2 0 2", "feed 2 0 -1", "rapid 2 0 10"}));
}

TEST(Interpreter, SetsTheZeroOfATurnedSystem) {
    // Rotated by 90°: X 10 of the program is machine Y 10. There L20 sets the position to (3, 4).
    EXPECT_EQ(motions(parse("G10 L2 P1 R90\nG0 X10 Y0\nG10 L20 P1 X3 Y4\nG0 X4 Y4\nG53 G0 X0 Y11\n", "linuxcnc")),
              (Rows{"rapid 10 0 0", "rapid 4 4 0", "rapid 4 4 0"}));
}

TEST(Interpreter, TakesBlanksInsideNumbersAndDiameters) {
    EXPECT_EQ(motions(parse("G 0 X 1 0 . 5\nG7 G0 X10\n", "linuxcnc")), (Rows{"rapid 10.5 0 0", "rapid 5 0 0"}));
}

TEST(Interpreter, EvaluatesExpressionsByTheirRanks) {
    EXPECT_EQ(
        motions(parse(
            "#1=[2+3*4**2]\n#<_k>=7\nG0 X#1 Y[#<_k> MOD 4] Z[SIN[30]*2]\nG0 X-#1 Y[[1 LT 2] AND [3 EQ 3]] Z[ATAN[1]/[1]]\n",
            "linuxcnc")),
        (Rows{"rapid 50 3 1", "rapid -50 1 45"}));
}

TEST(Interpreter, RunsOWords) {
    const char* text =
        "o100 sub\n  G1 X#1 F60\n  o101 if [#1 GT 2]\n    G1 Y#1\n  o101 else\n    G1 Y-1\n  o101 endif\no100 endsub\n"
        "#5=0\no1 while [#5 LT 2]\n#5=[#5+1]\no100 call [#5*2-1]\no1 endwhile\no2 repeat [2]\nG91 G1 Z1\no2 endrepeat\nM2\n";
    EXPECT_EQ(motions(parse(text, "linuxcnc")),
              (Rows{"feed 1 0 0", "feed 1 -1 0", "feed 3 -1 0", "feed 3 3 0", "feed 3 3 1", "feed 3 3 2"}));
}

TEST(Interpreter, RunsFanucSubprogramsAndMacros) {
    const char* text =
        "G91 G1 F60\nM98 P1000 L2\nM98 P20001\nG65 P2 X5 A2\nWHILE [#1 LT 2] DO 1\n#1=#1+1\nX1\nEND 1\nIF [1 EQ 1] GOTO 50\nX99\nN50 Y9\nM30\n"
        "O1000\nX10\nM99\nO0001\nY1\nM99\nO2\nX#24 Y#1\nM99\n";
    EXPECT_EQ(motions(parse(text, "fanuc")),
              (Rows{"feed 10 nan nan", "feed 20 nan nan", "feed 20 1 nan", "feed 20 2 nan", "feed 25 4 nan",
                    "feed 26 4 nan", "feed 27 4 nan", "feed 27 13 nan"}));
}

TEST(Interpreter, ReadsSiemensWords) {
    const Program p = parse(
        "DEF REAL _DEPTH\n_DEPTH=-2.5\nR1=4\nG0 X=R1*2 Y=AC(3) Z=_DEPTH\nG91 X=AC(1) Y=IC(2)\nG90 G3 X3 Y5 CR=-5 F60\nG2 X3 Y5 I0 J2 TURN=2\nTRAORI\n",
        "siemens");
    EXPECT_EQ(motions(p)[0], "rapid 8 3 -2.5");
    EXPECT_EQ(motions(p)[1], "rapid 1 5 -2.5");
    ASSERT_GE(p.motions.arcs.size(), 1u);
    EXPECT_EQ(p.motions.arcs.back().turns, 3);
    EXPECT_EQ(p.events.back().value, "TRAORI");
}

TEST(Interpreter, ReportsUnknownWordsWithTheirPlace) {
    const Program p = parse("G0 X1\nG777 P2\n", "fanuc");
    ASSERT_EQ(p.diagnostics.count("program.unknown-word"), 1u);
    EXPECT_EQ(p.diagnostics.kept()[0].where.text(), "test.nc:2:1");
}

TEST(Interpreter, StopsEndlessLoopsAndRecursion) {
    EXPECT_NE(error_of("o1 while [1]\no1 endwhile\n", "linuxcnc").find("an endless loop?"), std::string::npos);
    EXPECT_NE(error_of("o1 sub\no1 call\no1 endsub\no1 call\n", "linuxcnc").find("a subprogram that calls itself?"),
              std::string::npos);
    EXPECT_NE(error_of("M98 P77\n", "fanuc").find("subprogram '77' is neither in the program nor in its folder"),
              std::string::npos);
}

TEST(Interpreter, TakesANameWithoutALetterForNoAxis) {
    const Program p = parse("G0 X1\n$=5\n_=3\n", "siemens");
    EXPECT_EQ(p.diagnostics.count("program.unknown-word"), 2u);
    EXPECT_EQ(p.motions.size(), 1u);
}

TEST(Interpreter, BoundsTheMotionsOfRepeats) {
    InterpreterOptions options;
    options.most_repeated = 1000;
    EXPECT_THROW((void)parse_program(SourceText("t", "G90 G81 X1 Y1 Z-1 R1 L1000000 F100\n", nullptr), options),
                 InputError);
    EXPECT_GT(parse_program(SourceText("t", "G90 G81 X1 Y1 Z-1 R1 L200 F100\n", nullptr), options).motions.size(),
              500u);
}

TEST(Interpreter, SurvivesBrokenBlocks) {
    for (const char* text : {"X[1+", "#1=[", "G1 X[1/0]", "#<abc", "o1 if [", "G2 X1", "X1.2.3", "o[ call",
                             "G0 X[SQRT[-1]]", "((((", "\"\"\"", "N", "/", "%%", "o100", "#=", "G", "M", "[[[[[[[["}) {
        for (const Dialect& dialect : dialects()) {
            try {
                (void)parse(text, dialect.name.data());
            } catch (const InputError&) {  // a clear error is also a valid answer
            }
        }
    }
}

TEST(Program, ReadsARealFiveAxisProgram) {
    const Program p = io::read_program(SAMPLE_DATA "/programs/keychain.mpf");
    EXPECT_EQ(p.dialect->name, "siemens");
    EXPECT_GT(p.motions.size(), 500);
    EXPECT_EQ(p.diagnostics.count("program.unknown-word"), 0u);
    EXPECT_GT(p.motions.arcs.size(), 10u);
}

}  // namespace
}  // namespace clsurf::interpreter_test
