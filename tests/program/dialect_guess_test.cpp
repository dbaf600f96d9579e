#include "program/dialects/dialect_guess.h"

#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::dialect_guess_test {
namespace {

std::string guess(std::string_view text, std::string_view name = "part.nc") {
    return std::string(guess_dialect(text, name).dialect->name);
}

TEST(DialectGuess, FollowsWordsThatOneDialectWrites) {
    EXPECT_EQ(guess("N10 TRAORI\nN20 CYCLE832(0.01,1,1)\n"), "siemens");
    EXPECT_EQ(guess("o<x> sub\n#<a>=1\no<x> endsub\n"), "linuxcnc");
    EXPECT_EQ(guess("%X G71 *\nN10 G0 X1*\nN20 G1 X2*\nN30 X3*\n"), "heidenhain-iso");
    EXPECT_EQ(guess("O1000\nG90 G54 G0 X0\n"), "fanuc");
    EXPECT_EQ(guess("G0 X0 Y0\n"), "fanuc");
}

TEST(DialectGuess, SeesPolarWordsSplinesAndTolerancesOfLinuxCnc) {
    EXPECT_EQ(guess("(holes)\nG0 @3 ^45\nG0 ^90\n"), "linuxcnc");
    EXPECT_EQ(guess("G0 X0 Y0\nG5.2 X1 Y1 P2 L3\nX2 Y2 P1\nG5.3\n"), "linuxcnc");
    EXPECT_EQ(guess("G5 X1 Y1 I0 J1 P0 Q-1\n"), "linuxcnc");
    EXPECT_EQ(guess("G17 G21\nG64P0.01\n"), "linuxcnc");
    EXPECT_EQ(guess("%\n(finishing)\nG61\nG0 X1\n"), "linuxcnc");
    EXPECT_EQ(guess("%\nO0007\nG61\nG0 X1\n"), "fanuc");
    EXPECT_EQ(guess("(DEBUG, here)\nG0 X1\n"), "linuxcnc");
}

TEST(DialectGuess, SeesMacrosAndModesOfFanuc) {
    EXPECT_EQ(guess("G05 P10000\nG1 X1\n"), "fanuc");
    EXPECT_EQ(guess("G5.1 Q1 R5\nG43.4 H1\n"), "fanuc");
    EXPECT_EQ(guess("#100=#101+1\nIF[#100 GT 5]GOTO 10\nN10 M30\n"), "fanuc");
    EXPECT_EQ(guess("%\nO0001(PART)\nG65 P9100 A1.\nM99\n%\n"), "fanuc");
}

TEST(DialectGuess, SeesAssignmentsLabelsAndTitlesOfSiemens) {
    EXPECT_EQ(guess("%_N_PART_MPF\nG0 X0\n"), "siemens");
    EXPECT_EQ(guess_dialect("G0 X0\nCYCLE832(0.01,1)\n").reason, "'CYCLE832' in line 2");
    EXPECT_EQ(guess("R1=5\nG0 X=R1\n"), "siemens");
    EXPECT_EQ(guess("START:\nG0 X0\nGOTOB START\n"), "siemens");
    EXPECT_EQ(guess("G60\nG601\nG0 X0\n"), "siemens");
}

TEST(DialectGuess, CommentsAndQuotesSayNothing) {
    EXPECT_EQ(guess("(CYCLE832 TRAORI R1=5)\n; #<x> TRAORI\nO1\nG0 X0\n"), "fanuc");
    EXPECT_EQ(guess("G0 X0 (IF[1] GOTO 5)\nG64 P0.01\n"), "linuxcnc");
}

TEST(DialectGuess, TheEndingCountsLessThanAStrongWord) {
    EXPECT_EQ(guess("G0 X0\n", "part.ngc"), "linuxcnc");
    EXPECT_EQ(guess("G0 X0\n", "PART.MPF"), "siemens");
    EXPECT_EQ(guess("G05.1 Q1\nG0 X0\n", "part.ngc"), "fanuc");
    EXPECT_EQ(guess_dialect("G0 X0\n\n#<a>=1\n", "part.ngc").reason, "'#<' in line 3, the ending .ngc");
    EXPECT_EQ(guess_dialect("G0 X0\n", "part.nc").reason, "nothing in the text suggests another one");
}

TEST(DialectGuess, AnErrorNamesTheGuessAndTheOption) {
    const auto error_of_guess = [](const std::string& text, const Dialect* dialect) -> std::string {
        const auto kept = std::make_shared<std::string>(text);
        InterpreterOptions options;
        options.dialect = dialect;
        try {
            (void)parse_program(SourceText("test.nc", *kept, kept), options);
        } catch (const InputError& error) { return error.what(); }
        return "";
    };
    const std::string text = "O1000\nG0 X0 Y0\nG2 X10 Y0 I4\n";
    EXPECT_NE(error_of_guess(text, nullptr)
                  .find("hint: read as fanuc, a guess ('O1000' in line 1); choose another with --dialect"),
              std::string::npos)
        << error_of_guess(text, nullptr);
    EXPECT_EQ(error_of_guess(text, find_dialect("fanuc")).find("--dialect"), std::string::npos);
}

TEST(DialectGuess, KlartextAsDinIsoIsAnErrorThatSaysSo) {
    EXPECT_NE(error_of("0 BEGIN PGM PART MM\n1 L X+10 R0 FMAX\n", "heidenhain-iso")
                  .find("test.nc:1: error: is Klartext (BEGIN PGM), not DIN/ISO"),
              std::string::npos);
}

}  // namespace
}  // namespace clsurf::dialect_guess_test
