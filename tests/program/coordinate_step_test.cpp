// The step of coordinates, for texts with known decimals.

#include "program/coordinate_step.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/units.h"
#include "program/dialect.h"
#include "program/interpreter.h"

namespace clsurf::coordinate_step_test {
namespace {

double step_of(const std::string& text) {
    const auto bytes = std::make_shared<std::string>(text);
    InterpreterOptions options;
    options.dialect = find_dialect("linuxcnc");
    return coordinate_step(parse_program(SourceText("part.ngc", *bytes, bytes), options).motions);
}

TEST(CoordinateStep, IsThatOfTheFinestAxis) {
    EXPECT_NEAR(step_of("G21\nG1 X0.1 Y2.25 Z1.123 F100\nX0.2 Y2.5 Z1.378\nX0.3 Y3.75 Z1.001\n"), 0.001, 1e-12);
    EXPECT_NEAR(step_of("G21\nG1 X0.1 Y2.25 F100\nX0.2 Y2.51\n"), 0.01, 1e-12);
    EXPECT_NEAR(step_of("G21\nG1 X1 F100\nX2\n"), 0.1, 1e-12);  // the largest step that is tested
}

TEST(CoordinateStep, IsInInchesWhereTheyAre) {
    EXPECT_NEAR(step_of("G20\nG1 X0.1234 Y1.0002 F10\nX0.2341 Y1.0311\n"), 0.0001 * mm_per_inch, 1e-12);
}

TEST(CoordinateStep, IsThatOfTheWordsInARotatedFrame) {
    EXPECT_NEAR(step_of("G21\nG10 L2 P2 X10 Y20 R17.5\nG55\nG1 X0.123 Y1.002 Z0.5 F100\nX0.231 Y1.031 Z0.517\n"), 0.001,
                1e-12);
}

TEST(CoordinateStep, IsNothingForCoordinatesThatAreComputed) {
    EXPECT_EQ(step_of("G21\nG1 X[1/3] Y[SQRT[2]] F100\nX[2/3] Y[SQRT[3]]\nX[1/7] Y[SQRT[5]]\n"), 0);
    EXPECT_EQ(step_of("G21\n"), 0);
    EXPECT_EQ(step_of("G21\nG0 X1.23\n"), 0);  // no cut
}

TEST(CoordinateStep, ToleratesAFewOthers) {
    std::string text = "G21\nG1 X0.001 Y0.002 F100\nX[1/3] Y[1/7]\n";
    for (int i = 1; i < 40; ++i) text += "X0.0" + std::to_string(10 + i) + " Y0.1" + std::to_string(10 + i) + "\n";
    EXPECT_NEAR(step_of(text), 0.001, 1e-12);
}

}  // namespace
}  // namespace clsurf::coordinate_step_test
