// Words that move axes and are not understood end the reading: a path next to the true one is worse than none.

#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::refused_words_test {
namespace {

void expect_error(const std::string& text, const char* dialect, const std::string& begin, const std::string& hint) {
    const std::string error = error_of(text, dialect);
    EXPECT_TRUE(error.starts_with("test.nc:" + begin)) << error;
    EXPECT_NE(error.find(hint), std::string::npos) << error;
}

TEST(RefusedWords, SplinesOfOtherDialects) {
    expect_error("G0 X0 Y0\nG5.2 X1 Y1 P2 L3\n", "fanuc",
                 "2:1: error: G5.2 is not known in fanuc, and its block moves axes", "--dialect linuxcnc");
    expect_error("G0 X0 Y0\nG5.2 P2\n", "siemens", "2:1: error: G5.2 is not known in siemens, and moves axes",
                 "--dialect linuxcnc");
    expect_error("G0 X0 Y0\nG5 X1 Y1 I0 J1 P0 Q-1\n", "fanuc", "2:1: error: G5 ", "--dialect linuxcnc");
    expect_error("G0 X0 Y0\nN20 G06.1 K0 X1 Y1 R1\n", "fanuc", "2:5: error: G6.1 is not known", "not supported");
    expect_error("G0 X0 Y0\nG6.2 P3 X1 Y1\n", "siemens", "2:1: error: G6.2 is not known",
                 "a NURBS of fanuc and linuxcnc");
    expect_error("G0 X0 Y0\nG2.2 X1 Y1 R1\n", "fanuc", "2:1: error: G2.2 is not known", "involutes");
    expect_error("G0 X0 Y0\nINVCW X1\n", "siemens", "2:1: error: INVCW is not known in siemens", "involutes");
}

TEST(RefusedWords, DwellsThatNoLogHasRoomFor) {
    expect_error("G0 X0 Y0\nG4 P1000000000\n", "linuxcnc", "2", "the longest is 86400 s");
    expect_error("G0 X0 Y0 Z0\nG82 Z-1 R1 P1000000000 F60\n", "linuxcnc", "2", "the longest is 86400 s");
    EXPECT_EQ(motions(parse("G4 P86400\n", "linuxcnc")).size(), 1u);
}

TEST(RefusedWords, OperationsWithoutAResult) {
    expect_error("G0 Y0\nG1 X[[0-2]**0.5] F60\n", "linuxcnc", "2", "is not defined");
    expect_error("G0 Y0\nG1 X[10**400] F60\n", "linuxcnc", "2", "too large");
}

TEST(RefusedWords, UnknownCodesBesideAxes) {
    for (const char* dialect : {"fanuc", "siemens", "linuxcnc"})
        expect_error("G0 X0 Y0\nG999 X1\n", dialect, "2:1: error: G999 is not known in " + std::string(dialect),
                     "moves axes");
    expect_error("N10 G0 X0 Y0*\nN20 G599 X1*\n", "heidenhain-iso", "2:5: error: G599 is not known", "moves axes");
    // Without axes it is a mode of some machine.
    EXPECT_EQ(parse("G0 X0 Y0\nG187 P1\nX5\n", "fanuc").diagnostics.count("program.unknown-word"), 1u);
}

TEST(RefusedWords, InterpolationOfRotaryAxesAndAxesByTheirNames) {
    expect_error("G0 X0 Y0\nG12.1\n", "fanuc", "2:1: error: G12.1 is not known", "polar coordinate interpolation");
    expect_error("G0 X0 Y0\nG7.1 C20\n", "fanuc", "2:1: error: G7.1 is not known", "interpolation");
    EXPECT_EQ(motions(parse("G0 X0 Y0 Z0\nG7.1 C0\nG13.1\nX1\n", "fanuc")).size(), 2u);
    expect_error("G0 X0 Y0\nG1 X1=5 F100\n", "siemens", "2:4: error: X1= is not known in siemens", "");
}

TEST(RefusedWords, AxesWithoutAValue) {
    for (const char* dialect : {"fanuc", "linuxcnc", "heidenhain-iso"}) {
        expect_error("G0 X0 Y0\nG1 X1 Y F100\n", dialect, "2:7: error: Y has no value", "");
        expect_error("G0 X0 Y0\nG1 X1 YF100\n", dialect, "2:7: error: Y has no value", "");
    }
    expect_error("G0 X0 Y0\nG1 X1 Y F100\n", "siemens", "2:7: error: Y has no value", "");
    // Fanuc's vacant variable removes its word.
    EXPECT_EQ(motions(parse("G0 X0 Y0 Z0\nG1 X1 Y#100 F100\n", "fanuc")), (Rows{"rapid 0 0 0", "feed 1 0 0"}));
}

TEST(RefusedWords, TurnsOfArcsOfOtherDialects) {
    expect_error("G0 X0 Y0 Z0\nG2 X10 Y0 I5 P2 F60\n", "fanuc",
                 "2:14: error: P in a block with an arc is not known in fanuc", "--dialect linuxcnc");
    expect_error("G0 X0 Y0 Z0\nG2 X10 Y0 I5 L2 F60\n", "fanuc", "2:14: error: L in a block with an arc", "spirals");
    expect_error("G0 X0 Y0 Z0\nG2 X10 Y0 I5 P2 F60\n", "siemens", "2:14: error: P in a block with an arc", "TURN=");
}

TEST(RefusedWords, PositioningCodesOfFanucAreCarriedOut) {
    // G27 and G29 end at their positions, G60 approaches from one side, G31 is assumed to touch at its end.
    const Program p = parse("G0 X0 Y0 Z0\nG27 X5\nG60 Y5\nG29 X1 Y1\nG1 Z-1 F60\nG31 P1 Z-9 F120\nX3\n", "fanuc");
    EXPECT_EQ(motions(p), (Rows{"rapid 0 0 0", "rapid 5 0 0", "rapid 5 5 0", "rapid 1 1 0", "feed 1 1 -1",
                                "feed 1 1 -9", "feed 3 1 -9"}));
    // The F of G31 is modal.
    EXPECT_FLOAT_EQ(p.motions.feed[5], 2);
    EXPECT_FLOAT_EQ(p.motions.feed[6], 2);
}

TEST(RefusedWords, MessagesHoldNoControlCharacters) {
    const std::string error = error_of("G0 X1\nG1 \x1b[2J\x07 \xff\n", "fanuc");
    ASSERT_FALSE(error.empty());
    for (const char c : error) EXPECT_TRUE(c == '\n' || (c >= ' ' && c != '\x7f')) << error;
}

}  // namespace
}  // namespace clsurf::refused_words_test
