// Splines in the simulation: run along the exact curve, as fast as the limits allow, in every notation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "simulation/path/spline_sections.h"
#include "support/made_motion.h"

namespace clsurf::spline_test {
namespace {

/// A half circle of radius 10, in four rational quadratic pieces of 45°, and the same as one arc.
const std::string arcs_of_circle =
    "G5.2 P1 L3\nX10 Y4.142135623730951 P0.9238795325112867\nX7.071067811865475 Y7.071067811865475 P1\nG5.3\n"
    "G5.2 P1 L3\nX4.142135623730951 Y10 P0.9238795325112867\nX0 Y10 P1\nG5.3\n"
    "G5.2 P1 L3\nX-4.142135623730951 Y10 P0.9238795325112867\nX-7.071067811865475 Y7.071067811865475 P1\nG5.3\n"
    "G5.2 P1 L3\nX-10 Y4.142135623730951 P0.9238795325112867\nX-10 Y0 P1\nG5.3\n";
std::string half_circle(bool spline, const std::string& mode) {
    return "G21 G90 " + mode + "\nG0 X10 Y0\nF6000\n" + (spline ? arcs_of_circle : "G3 X-10 Y0 I-10 J0\n") + "M2\n";
}

TEST(Splines, ACircleOfSplinesIsDrivenAsTheArc) {
    for (const char* mode : {"G64 P0.01", "G61"}) {
        const Recorded arc = run_program(program_of(half_circle(false, mode)), Machine{});
        const Recorded spline = run_program(program_of(half_circle(true, mode)), Machine{});
        EXPECT_TRUE(spline.summary.limits_ok) << mode;
        EXPECT_NEAR(spline.summary.duration, arc.summary.duration, 0.01 * arc.summary.duration) << mode;
        double off = 0;
        for (const SimulatedPoint& point : spline.points) {
            // The corner at the beginning of the circle is rounded.
            if (point.commanded.y() > 5) off = std::max(off, std::abs(point.commanded.norm() - 10));
        }
        EXPECT_LE(off, 1e-6) << mode;
    }
}

TEST(Splines, TheTridentKeepsTheLimitsOfItsMachineInAllPlanners) {
    const Program program = program_of(
        "G21 G90\nG0 X10 Y0 Z0\nF3000\nG5.2 P1 L4\nX20 Y20 P1\nX12 Y8 P1\nX10 Y20 P1\nX8 Y8 P1\nX0 Y20 P1\nX10 Y0 P1\nG5.3\nM2\n");
    for (const CornerMode corner : {CornerMode::arc, CornerMode::spline, CornerMode::stop, CornerMode::junction}) {
        for (const bool jerk : {true, false}) {
            Machine machine;
            machine.controller.corner = corner;
            for (MachineAxis& axis : machine.axes) axis.max_jerk = jerk ? axis.max_jerk : 0;
            const Recorded r = run_program(program, machine);
            EXPECT_TRUE(r.summary.limits_ok) << int(corner) << jerk;
            EXPECT_LE(r.summary.duration, 2) << int(corner) << jerk;
            EXPECT_EQ(r.points.back().commanded, Vec3(10, 0, 0));
        }
    }
    Machine kernel;
    kernel.controller.planner = PlannerKind::trapezoidal;
    for (MachineAxis& axis : kernel.axes) axis.max_jerk = 0;
    const Recorded r = run_program(program, kernel);
    EXPECT_TRUE(r.summary.limits_ok);
    EXPECT_LE(r.summary.duration, 2);
}

/// A source of one element.
class OneElement final : public ElementSource {
public:
    explicit OneElement(PathElement element) : element_(std::move(element)) {}
    bool next(PathElement& element) override {
        if (given_) return false;
        given_ = true;
        element = element_;
        return true;
    }

private:
    PathElement element_;
    bool given_ = false;
};

TEST(Splines, SectionsAreArcsWithCommonTangentsBesideTheCurve) {
    const std::vector<Vec3> points{{0, 0, 0}, {2, 6, 0}, {7, -5, 0}, {9, 3, 0}};
    const auto curve = std::make_shared<const BezierCurve>(points);
    OneElement source(element_of(curve));
    SplineSections sections(source);
    PathElement section;
    Vec3 at(0, 0, 0), tangent = curve->tangent(0);
    double length = 0;
    int count = 0;
    while (sections.next(section)) {
        ++count;
        EXPECT_LE((section.begin - at).norm(), 1e-12);
        EXPECT_LE((section.tangent(0).normalized() - tangent).norm(), 1e-6);
        for (int k = 0; k <= 8; ++k)
            EXPECT_LE(curve->nearest(section.at(section.length * k / 8)).distance, 1.2 * SplineSections::error);
        at = section.end;
        tangent = section.tangent(section.length).normalized();
        length += section.length;
    }
    EXPECT_LE((at - points.back()).norm(), 1e-12);
    EXPECT_NEAR(length, curve->length(), 1e-3);
    EXPECT_GT(count, 4);
    EXPECT_LT(count, 200);  // chords with the same error would be 500
}

}  // namespace
}  // namespace clsurf::spline_test
