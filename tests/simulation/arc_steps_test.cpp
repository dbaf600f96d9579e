// Arcs in corners of machines whose axes have jerk limits: speeds and times compared with values computed by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "simulation/path/arc_steps.h"
#include "simulation/path/transition_arc.h"
#include "support/made_motion.h"

namespace clsurf::arc_steps_test {
namespace {

constexpr double tolerance = 0.01, feed = 50, axis_jerk = 80000, path_jerk = 50000, period = 0.001;

Machine stepping() {
    Machine machine;
    machine.controller.corner = CornerMode::arc;
    machine.controller.arc_step_time = period;
    return machine;
}

PathElement line(const Vec3& from, const Vec3& to) { return element_of(MotionKind::feed, nullptr, from, to); }

double speed_at(const Vec3& from, const Vec3& to, const Machine& machine, double error = tolerance) {
    const PathElement arc = transition_arc(line(from, Vec3::Zero()), line(Vec3::Zero(), to), error).element();
    return ArcSteps(machine).speed(arc, Vec3::Zero(), Vec3::Zero());
}

// 90°: r = e cos 45°/(1 − cos 45°), and the step is along one axis.
const double right_angle_radius = tolerance * std::sqrt(0.5) / (1 - std::sqrt(0.5));
const double right_angle_speed = std::sqrt(axis_jerk * right_angle_radius * period);

TEST(ArcSteps, ASquareCornerIsPassedAtTheRootOfJerkRadiusAndTime) {
    Machine machine = stepping();
    EXPECT_NEAR(right_angle_speed, 1.389738, 1e-6);
    EXPECT_NEAR(speed_at({-1, 0, 0}, {0, 1, 0}, machine), right_angle_speed, 1e-9);
    machine.controller.arc_step_time = 0.002;
    EXPECT_NEAR(speed_at({-1, 0, 0}, {0, 1, 0}, machine), std::sqrt(2.0) * right_angle_speed, 1e-9);
    machine.axes[1].max_jerk = 0.25 * axis_jerk;  // the step at the beginning is along y
    EXPECT_NEAR(speed_at({-1, 0, 0}, {0, 1, 0}, machine), std::sqrt(0.5) * right_angle_speed, 1e-9);
    machine.axes[1].max_jerk = 0;  // not limited: the step at the end counts
    EXPECT_NEAR(speed_at({-1, 0, 0}, {0, 1, 0}, machine), std::sqrt(2.0) * right_angle_speed, 1e-9);
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    EXPECT_FALSE(ArcSteps(machine).count());
}

// Across the axes the step along each is 1/√2 of its size; after it the normal turns towards y by the angle of a period.
TEST(ArcSteps, WhatTheArcTurnsWithinTheTimeCounts) {
    const double steps_alone = std::sqrt(axis_jerk * period * right_angle_radius * std::sqrt(2.0));
    const double turned = steps_alone * period / right_angle_radius;
    const double both = std::sqrt(axis_jerk * period * right_angle_radius / std::cos(0.25 * std::numbers::pi - turned));
    EXPECT_NEAR(speed_at({-1, -1, 0}, {1, -1, 0}, stepping()), both, 1e-9);
}

// If the whole arc is within the time, both of its steps are: for 120°, with normals at 90° ± 60°, they have
// √3/2 with opposite signs along x and the full size along y.
TEST(ArcSteps, BothEndsWithinTheTimeAddUp) {
    const Vec3 from(-0.5, -std::sqrt(0.75), 0), to(0.5, -std::sqrt(0.75), 0);
    Machine machine = stepping();
    const double error = 1e-5, radius = radius_at_error(2 * std::numbers::pi / 3, error);
    const double alone = std::sqrt(axis_jerk * period * radius / std::sqrt(0.75));
    ASSERT_GT(alone * period, 2 * std::numbers::pi / 3 * radius);
    EXPECT_NEAR(speed_at(from, to, machine, error), std::sqrt(axis_jerk * period * radius / std::sqrt(3.0)), 1e-9);
}

/// Time of a ramp from one speed to another, without acceleration at its ends.
double ramp_time(double change) { return 2 * std::sqrt(change / path_jerk); }  // below a²/j = 80 mm/s
double ramp_way(double low, double high) { return 0.5 * (low + high) * ramp_time(high - low); }

/// Time of a line from one speed to another through the highest speed.
double line_time(double way, double start, double end) {
    const auto ramps = [&](double speed) { return ramp_way(start, speed) + ramp_way(end, speed); };
    double low = std::max(start, end), high = feed;
    if (ramps(feed) <= way) return ramp_time(feed - start) + ramp_time(feed - end) + (way - ramps(feed)) / feed;
    for (int k = 0; k < 100; ++k) (ramps(0.5 * (low + high)) <= way ? low : high) = 0.5 * (low + high);
    return ramp_time(low - start) + ramp_time(low - end);
}

/// Time of lines of a length, with corners of 90° between them that are passed at a given speed: at this speed for one and a
/// half periods on each side of every arc, and over the arcs.
double time_on_paper(int lines, double length, double corner_speed) {
    const double beside = 1.5 * period;
    double time = (lines - 1) * 0.5 * std::numbers::pi * right_angle_radius / corner_speed;
    for (int k = 0; k < lines; ++k) {
        const int arcs = (k > 0 ? 1 : 0) + (k + 1 < lines ? 1 : 0);
        time += arcs * beside + line_time(length - arcs * (right_angle_radius + corner_speed * beside),
                                          k > 0 ? corner_speed : 0, k + 1 < lines ? corner_speed : 0);
    }
    return time;
}

void expect_time_on_paper(const char* program, double time) {
    const Recorded r = run_program(program_of(program), stepping());
    EXPECT_NEAR(r.summary.duration, time, period + 1e-3 * time);
    EXPECT_TRUE(r.summary.limits_ok);
    EXPECT_LE(r.summary.path_deviation, tolerance * (1 + 1e-9));
    EXPECT_GT(r.summary.path_deviation, 0.99 * tolerance);
}

TEST(ArcSteps, ASquareTakesTheTimeOnPaper) {
    expect_time_on_paper("G21 G90 G64\nG1 X10 F3000\nY10\nX0\nY0\nM2\n", time_on_paper(4, 10, right_angle_speed));
}

TEST(ArcSteps, AZigzagTakesTheTimeOnPaper) {
    expect_time_on_paper("G21 G90 G64\nG1 X1 Y1 F3000\nX2 Y0\nX3 Y1\nX4 Y0\nX5 Y1\nX6 Y0\nM2\n",
                         time_on_paper(6, std::sqrt(2.0), speed_at({-1, -1, 0}, {1, -1, 0}, stepping())));
}

// The corner is an arc: all points between the lines have the same distance from the centre.
TEST(ArcSteps, PointsInTheCornerLieOnTheArc) {
    const Recorded r = run_program(program_of("G21 G90 G64\nG1 X10 F3000\nY10\nM2\n"), stepping());
    const Vec3 centre(10 - right_angle_radius, right_angle_radius, 0);
    int on_arc = 0;
    for (const SimulatedPoint& p : r.points) {
        if (p.commanded.x() <= centre.x() || p.commanded.y() >= centre.y()) continue;
        EXPECT_NEAR((p.commanded - centre).norm(), right_angle_radius, 1e-9);
        EXPECT_NEAR(p.speed, right_angle_speed, 1e-3 * right_angle_speed);
        ++on_arc;
    }
    EXPECT_GT(on_arc, 20);
}

// Without a time for the steps, splines replace arcs, as if they were selected.
TEST(ArcSteps, WithoutATimeThereAreSplines) {
    const Program program = program_of("G21 G90 G64\nG1 X10 F3000\nY10\nM2\n");
    Machine machine = stepping();
    machine.controller.arc_step_time = 0;
    const Recorded arcs = run_program(program, machine);
    machine.controller.corner = CornerMode::spline;
    const Recorded splines = run_program(program, machine);
    ASSERT_EQ(arcs.points.size(), splines.points.size());
    for (std::size_t i = 0; i < arcs.points.size(); ++i)
        EXPECT_EQ(arcs.points[i].commanded, splines.points[i].commanded);
}

}  // namespace
}  // namespace clsurf::arc_steps_test
