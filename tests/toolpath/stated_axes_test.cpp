// The tool axes that programs state by tilted planes, and those that need the machine's kinematics.

#include "toolpath/stated_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/made_five_axis.h"

namespace clsurf::stated_axes_test {
namespace {

StatedAxes axes_of(const std::string& text, const char* dialect) {
    return stated_axes(test::parse_text(text, dialect).motions);
}

void expect_axis(const StatedAxes& stated, std::size_t motion, const Vec3& axis) {
    EXPECT_FALSE(stated.unknown);
    ASSERT_LT(motion, stated.axis.size());
    EXPECT_NEAR((stated.axis[motion].vec() - axis).norm(), 0, 1e-12) << motion;
}

// z rotated by 30 deg about Y: (sin 30, 0, cos 30).
const Vec3 about_y(0.5, 0, std::sqrt(0.75));

TEST(StatedAxes, OfTiltedPlanesOfEachDialect) {
    const std::string cut = "G0 X0 Y0 Z30\nG1 Z0 F500\nX10\nM30\n";
    expect_axis(axes_of("G17 G90 G54\nCYCLE800(1,\"T\",0,57,0,0,0,0,30,0,0,0,0,1)\n" + cut, "siemens"), 2, about_y);
    expect_axis(axes_of("G90 G54\nG68.2 X0 Y0 Z0 I90 J30 K-90\nG53.1\n" + cut, "fanuc"), 2, about_y);
    expect_axis(axes_of("0 BEGIN PGM T MM\n1 TOOL CALL 5 Z S1000\n2 PLANE SPATIAL SPA+0 SPB+30 SPC+0 TURN FMAX\n"
                        "3 L X+0 Y+0 Z+30 R0 FMAX\n4 L Z+0 F500\n5 L X+10\n6 END PGM T MM\n",
                        "klartext"),
                2, about_y);
}

TEST(StatedAxes, OfEachPlaneByItself) {
    const StatedAxes stated = axes_of(
        "G17 G90 G54\nG0 X0 Y0 Z30\nG1 X1 F500\nCYCLE800(1,\"T\",0,57,0,0,0,0,30,0,0,0,0,1)\nG1 X2\n"
        "CYCLE800(1,\"T\",0,57,0,0,0,0,-90,0,0,0,0,1)\nG1 X3\nG1 X4\n",
        "siemens");
    ASSERT_EQ(stated.axis.size(), 7U);  // with a turn onto each plane
    expect_axis(stated, 1, Vec3::UnitZ());
    expect_axis(stated, 3, about_y);
    expect_axis(stated, 6, -Vec3::UnitX());
}

TEST(StatedAxes, APlaneThatIsOnlyStatedTurnsNoTool) {
    const StatedAxes stated =
        axes_of("G17 G90 G54\nCYCLE800(1,\"T\",0,57,0,0,0,0,30,0,0,0,0,0)\nG0 X0 Y0 Z30\nG1 X10 F500\n", "siemens");
    EXPECT_TRUE(stated.axis.empty());
    EXPECT_FALSE(stated.unknown);
}

TEST(StatedAxes, AnglesAndTurnsOfTheToolAreLeftToTheMachine) {
    EXPECT_TRUE(axes_of("G90 G54\nG0 X0 Y0 Z30\nG0 A30\nG1 X10 F500\n", "fanuc").unknown);
    EXPECT_TRUE(axes_of("G90 G54\nG0 X0 Y0 Z30\nG1 X10 C90 F500\n", "fanuc").unknown) << "the part turns under the cut";
    EXPECT_TRUE(axes_of("TRAORI\nG0 X0 Y0 Z30\nG1 X10 A3=0 B3=0 C3=1 F500\nX20 A3=0.1 B3=0 C3=1\n", "siemens").unknown);
    EXPECT_FALSE(axes_of("G90 G54\nG0 X0 Y0 Z30 C90\nG1 X10 F500\n", "fanuc").unknown) << "about its own axis";
    EXPECT_FALSE(axes_of("G90 G54\nG0 X0 Y0 Z30\nG0 A30\nG0 A0\nG1 X10 F500\n", "fanuc").unknown);
}

}  // namespace
}  // namespace clsurf::stated_axes_test
