// Exact stops and corner tolerances in each dialect.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "program/motion_rows.h"

namespace clsurf::path_modes_test {
namespace {

/// "motion end tolerance" of every event that sets a path mode; ends: rounded, path, stop; "own" and "free" tolerances.
Rows modes(const std::string& text, const char* dialect) {
    Rows all;
    for (const ProgramEvent& event : parse(text, dialect).events) {
        if (!event.path_mode()) continue;
        static constexpr const char* ends[] = {"rounded", "path", "stop"};
        const double t = event.path_mode()->tolerance;
        const std::string tolerance = std::isnan(t)   ? "own"
                                      : std::isinf(t) ? "free"
                                                      : std::to_string(std::lround(t * 1e6));
        all.push_back(std::to_string(event.motion) + " " + ends[static_cast<int>(event.path_mode()->block_end)] + " " +
                      (event.path_mode()->block_end == BlockEnd::rounded ? tolerance : "-"));
    }
    return all;
}

TEST(PathModes, OfLinuxCncAreExactPathExactStopAndATolerance) {
    EXPECT_EQ(modes("G61\nG0 X1\nG61.1\nG64\nG64 P0.01 Q0.002\n", "linuxcnc"),
              (Rows{"0 path -", "1 stop -", "1 rounded free", "1 rounded 10000"}));
}

TEST(PathModes, TheToleranceOfInchProgramsIsInInches) {
    EXPECT_EQ(modes("G20\nG64 P0.001\n", "linuxcnc"), (Rows{"0 rounded 25400"}));
    EXPECT_EQ(modes("G70\nCYCLE832(0.001,1)\n", "siemens"), (Rows{"0 rounded 25400"}));
}

TEST(PathModes, OfFanucStopAtTheEndOfEveryBlockOrOfOne) {
    EXPECT_EQ(modes("G61\nG0 X1\nG64\nG9 X2\nX3\n", "fanuc"),
              (Rows{"0 stop -", "1 rounded free", "1 stop -", "2 rounded free"}));
}

TEST(PathModes, OfSiemensAreG60G9G64AndItsKin) {
    EXPECT_EQ(modes("G60\nG0 X1\nG642\nX2 G9\nX3\nG64\n", "siemens"),
              (Rows{"0 stop -", "1 rounded own", "1 stop -", "2 rounded own", "3 rounded free"}));
    EXPECT_NE(error_of("G0 X1\nG61\n", "siemens").find("test.nc:2:1: error: G61 is not a word of siemens"),
              std::string::npos);
    EXPECT_NE(error_of("G0 X1\nG61\n", "siemens").find("hint: the exact stop of siemens is G60 or G9"),
              std::string::npos);
}

TEST(PathModes, Cycle832TakesVariablesExpressionsAndNames) {
    const std::string program =
        "DEF REAL _TOL=0.02\nCYCLE832(_TOL,1,1)\nCYCLE832(_TOL*2,_FINISH)\nCYCLE832(0.01,_ORI_ROUGH,0.5)\n"
        "G60\nCYCLE832(0,_OFF,1)\nCYCLE832(0.05,112103)\nG64\nCYCLE832()\n";
    EXPECT_EQ(modes(program, "siemens"),
              (Rows{"0 rounded 20000", "0 rounded 40000", "0 rounded 10000", "0 stop -", "0 rounded own",
                    "0 rounded 50000", "0 rounded 50000", "0 rounded own"}));
    // A variable of the control: if the program gives it a value, that is the tolerance, otherwise the machine's own
    // tolerance counts.
    EXPECT_EQ(modes("_CAMTOL=0.03\nCYCLE832(_CAMTOL,1)\nCYCLE832(_NOWHERE,1)\n", "siemens"),
              (Rows{"0 rounded 30000", "0 rounded own"}));
    const Program unknown = parse("G0 X1\nCYCLE832(_NOWHERE,1)\n", "siemens");
    ASSERT_EQ(unknown.diagnostics.count("program.variable"), 1u);
    EXPECT_EQ(unknown.diagnostics.kept()[0].where.text(), "test.nc:2:1");
}

TEST(PathModes, CtolReplacesTheTolerance) {
    EXPECT_EQ(modes("G642 CTOL=0.03\nCTOL=-1\n", "siemens"),
              (Rows{"0 rounded 30000", "0 rounded 30000", "0 rounded own"}));
}

}  // namespace
}  // namespace clsurf::path_modes_test
