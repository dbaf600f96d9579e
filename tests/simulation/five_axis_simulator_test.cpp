// Simulation of five axes: all limits are met, the tip keeps to its path, angles are reached.

#include "simulation/run/five_axis_simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "io/readers/machine_file.h"
#include "simulation/path/five_axis_path.h"
#include "simulation/plan/five_axis_speeds.h"
#include "support/made_five_axis.h"
#include "toolpath/tip_motions.h"
#include "toolpath/toolpath.h"

namespace clsurf::five_axis_simulator_test {
namespace {

const Vec3 zero(5, -8, 12);

struct Recorded {
    Program program;
    std::vector<FiveAxisPoint> points;
    FiveAxisSummary summary;
};

Recorded run(const std::string& text, const Machine& machine) {
    Recorded r;
    r.program = test::parse_text(text);
    solve_tool_axes(r.program, machine);
    make_tip_motions(r.program, machine.kinematics, -zero, Vec3::Zero());
    r.summary = simulate_five_axis(
        r.program, machine, zero, Vec3::Zero(),
        [&](std::span<const FiveAxisPoint> p) { r.points.insert(r.points.end(), p.begin(), p.end()); }, {});
    return r;
}

Machine trunnion() { return io::read_machine(SAMPLE_DATA "/machines/five_axis_trunnion.toml"); }

ToolPose pose_of(const Machine& machine, const std::array<double, 5>& axes) {
    ToolPose pose = machine.kinematics.to_workpiece(Vec3(axes[0], axes[1], axes[2]), {axes[3], axes[4]});
    pose.tip -= zero;
    return pose;
}

/// The largest ratio of speed, acceleration and jerk of each axis to its limit, by differences.
double worst_share(const Recorded& r, const Machine& machine) {
    double worst = 0;
    const double t = machine.controller.period;
    for (std::size_t k = 0; k < 5; ++k) {
        const MachineAxis& axis = k < 3 ? machine.axes[k] : machine.rotary[k - 3];
        const auto p = [&](std::size_t i) { return r.points[i].commanded[k]; };
        for (std::size_t i = 3; i < r.points.size(); ++i) {
            worst = std::max({worst, std::abs(p(i) - p(i - 1)) / t / axis.max_speed,
                              std::abs(p(i) - 2 * p(i - 1) + p(i - 2)) / (t * t) / axis.max_acceleration,
                              std::abs(p(i) - 3 * p(i - 1) + 3 * p(i - 2) - p(i - 3)) / (t * t * t) / axis.max_jerk});
        }
    }
    return worst;
}

TEST(FiveAxisSimulator, ADomeHoldsLimitsAndPath) {
    for (const ToolAxisInterpolation mode :
         {ToolAxisInterpolation::linear, ToolAxisInterpolation::vector, ToolAxisInterpolation::safe}) {
        Machine machine = trunnion();
        machine.kinematics.interpolation = mode;
        const Recorded r = run(test::dome_program(), machine);
        EXPECT_TRUE(r.summary.run.limits_ok) << name_of(mode);
        EXPECT_LE(worst_share(r, machine), 1.0011) << name_of(mode);
        // Every tip is within the corner tolerance of the programmed path; programmed axis positions are reached.
        const Toolpath path(r.program.motions, Vec3::Zero());
        double off = 0;
        for (std::size_t i = 0; i < r.points.size(); i += 7) {
            const Vec3 tip = pose_of(machine, r.points[i].commanded).tip;
            double nearest = 1e9;
            for (std::int64_t m = 0; m < path.size(); ++m) {
                const LineNumber line = r.program.motions.line[static_cast<std::size_t>(m)];
                if (line + 2 >= r.points[i].line && line <= r.points[i].line + 2)
                    nearest = std::min(nearest, path.projection(m, tip).distance);
            }
            off = std::max(off, nearest);
        }
        EXPECT_LE(off, 1.05 * machine.controller.tolerance) << name_of(mode);
        const ToolPose end = pose_of(machine, r.points.back().commanded);
        const auto last = static_cast<std::size_t>(r.program.motions.size() - 1);
        EXPECT_LE((end.tip - r.program.motions.end[last].vec()).norm(), 1e-9) << name_of(mode);
        EXPECT_LE(angle_between(end.axis, machine.kinematics.axis_of(
                                              machine.kinematics.angles_of(r.program.motions.rotary[last].vec()))),
                  1e-9);
        // Smoothing over a triangle of 16 periods takes up to half a degree from the changes of direction at the ends of
        // passes.
        EXPECT_LT(r.summary.orientation_error, 0.6 * rad_per_deg) << name_of(mode);
    }
}

// Near the pole C turns by 20° per millimetre: a step of the angles at a rounded corner, and the jerk of the tip between
// blocks of different speed, would exceed its limits. Some lines of a dome on both sides of the pole.
TEST(FiveAxisSimulator, LinesNearThePoleHoldTheLimitsOfTheRotation) {
    std::ifstream file(SAMPLE_DATA "/programs/dome_five_axis.nc");
    std::string text, line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (number <= 8 || (number >= 548 && number <= 570)) text += line + "\n";
    }
    const Machine machine = trunnion();
    const Recorded r = run(text + "M30\n", machine);
    EXPECT_TRUE(r.summary.run.limits_ok);
    EXPECT_LE(worst_share(r, machine), 1.0011);
    EXPECT_LT(r.summary.run.duration, 15) << "slower than it must be";
    // The angles of the last block are reached.
    const RotaryAngles last =
        machine.kinematics.angles_of(r.program.motions.rotary[r.program.motions.kind.size() - 1].vec());
    EXPECT_NEAR(r.points.back().commanded[4], last.rotation, 1e-12);
}

// The tool turns with the tip in place: five axes move, the tip does not.
TEST(FiveAxisSimulator, TurningOnTheSpotKeepsTheTip) {
    const Machine machine = trunnion();
    const Recorded r = run("G21 G90\nG43.4 H1\nG1 X10 Y5 Z3 F2000\nA-40 C90\nX20\nM30\n", machine);
    EXPECT_TRUE(r.summary.run.limits_ok);
    int turned = 0;
    for (const FiveAxisPoint& p : r.points) {
        if (p.line != 4) continue;
        ++turned;
        EXPECT_LE((pose_of(machine, p.commanded).tip - Vec3(10, 5, 3)).norm(), 1e-9);
    }
    EXPECT_GT(turned, 100);
    EXPECT_NEAR(r.points.back().commanded[3], -40 * rad_per_deg, 1e-12);
    EXPECT_NEAR(r.points.back().commanded[4], 90 * rad_per_deg, 1e-12);
}

/// The time of line 4, which turns by 90°, from (10, 5, 3) [s].
double turning_time(const std::string& line, double feed_override, bool planned_by_tip = false) {
    Machine machine = trunnion();
    machine.controller.feed_override = feed_override;
    if (planned_by_tip)
        for (MachineAxis& axis : machine.rotary) axis.max_jerk = 1e8;
    const Recorded r = run("G21 G90\nG43.4 H1\nG1 X10 Y5 Z3 F2000\n" + line + "\nX20\nM30\n", machine);
    const auto points = std::count_if(r.points.begin(), r.points.end(), [](const auto& p) { return p.line == 4; });
    return static_cast<double>(points) * machine.controller.period;
}

// 90° at 1800 deg/min are 3 s, and ramps of C some hundredths; half of the feed takes twice as long. Without a feed C
// turns at 18000 deg/min.
TEST(FiveAxisSimulator, ATurnKeepsItsFeedInDegrees) {
    EXPECT_NEAR(turning_time("G1 C90 F1800", 1), 3.05, 0.05);
    EXPECT_NEAR(turning_time("G1 C90 F1800", 0.5), 6.05, 0.05);
    EXPECT_NEAR(turning_time("G93 G1 C90 F20\nG94 F2000", 1), 3.05, 0.05);
    EXPECT_NEAR(turning_time("G1 C90 F1800", 1, true), 3.02, 0.03);
    EXPECT_LT(turning_time("G0 C90\nG1", 0.5), 0.6);
}

// 100 mm at 3000 mm/min are 2 s, at half of it 4 s; both have ramps in addition.
TEST(FiveAxisSimulator, FeedOverrideHolds) {
    Machine machine = trunnion();
    const std::string text = "G21 G90\nG43.4 H1\nG1 X100 A-20 F3000\nM30\n";
    const double whole = run(text, machine).summary.run.duration;
    machine.controller.feed_override = 0.5;
    const Recorded half = run(text, machine);
    EXPECT_NEAR(half.summary.run.duration - whole, 2, 0.05);
    EXPECT_EQ(half.points[half.points.size() / 2].limit, LimitingFactor::feed_override);
    EXPECT_TRUE(half.summary.run.diagnostics.empty());
    machine.controller.block_time = 0.003;
    const Recorded with = run(text, machine);
    ASSERT_EQ(with.summary.run.diagnostics.kept().size(), 1U);
    EXPECT_EQ(with.summary.run.diagnostics.kept()[0].text.find("block_time: without effect"), 0U);
}

// Without tool centre point control C turns in chords, here about the tip: one turn at the feed, not 180 from rest to rest.
TEST(FiveAxisSimulator, ATurnAboutTheTipIsOne) {
    Machine machine = trunnion();
    machine.kinematics = {};
    machine.kinematics.type = KinematicsType::table_table;
    Program program = test::parse_text("G21 G90\nG1 Z5 F3000\nC90 F3600\nM30\n");
    make_tip_motions(program, machine.kinematics, Vec3::Zero(), Vec3::Zero());
    const FiveAxisSummary summary =
        simulate_five_axis(program, machine, Vec3::Zero(), Vec3::Zero(), [](std::span<const FiveAxisPoint>) {}, {});
    EXPECT_NEAR(summary.run.duration, 1.7, 0.15);
}

// 20 mm at 1000 mm/min are 1.2 s, plus ramps of some hundredths: A turns within its limits at that feed. It once took hours.
TEST(FiveAxisSimulator, AShortLineTakesTheTimeOfItsFeed) {
    Machine machine;
    machine.kinematics.type = KinematicsType::table_table;
    const Recorded r = run("G21 G90\nG43.4 H1\nG1 X20 A40 F1000\nM30\n", machine);
    EXPECT_TRUE(r.summary.run.limits_ok);
    EXPECT_GT(r.summary.run.duration, 1.2);
    EXPECT_LT(r.summary.run.duration, 1.4);
}

// Without tool centre point control, X moves while A turns, whether Y and Z were named before or not.
TEST(FiveAxisSimulator, AxesThatWereNotNamedStandAtTheStart) {
    Machine machine;
    machine.kinematics.type = KinematicsType::table_table;
    for (const char* text : {"G21 G90\nG1 X20 A40 F1000\nM30\n", "G21 G90\nG0 X0 Y0\nG1 X20 C40 F1000\nM30\n",
                             "G21 G90\nG0 Z0\nG0 X0 A0\nG1 X20 A40 F1000\nM30\n"}) {
        const Recorded r = run(text, machine);
        EXPECT_GT(r.summary.run.duration, 1.2) << text;
        EXPECT_LT(r.summary.run.duration, 1.8) << text;  // F counts along the tip, which also moves by the turn
        const std::array<double, 5>&first = r.points.front().commanded, &last = r.points.back().commanded;
        EXPECT_NEAR(last[0] - first[0], 20, 1e-4) << text;
        EXPECT_NEAR(last[1] - first[1], 0, 1e-4) << text;
        EXPECT_NEAR(last[2] - first[2], 0, 1e-4) << text;
    }
}

// From corner to corner of such a zigzag the tip nearly reverses, where its speed has to fall within a thousandth of a millimetre.
TEST(FiveAxisSimulator, LongRapidsThatNearlyReverseArePlanned) {
    const Machine machine = trunnion();
    std::string text = "G17 G21 G90\nG43.4 H1\nG0 X0 Y0 Z0 A0 C0\n";
    for (int i = 1; i <= 16; ++i)
        text += fmt::format("X{} Y{} Z{} A{} C{}\n", 200 * (i % 2), 2 * i, i % 5, 10 * (i % 2), 7 * i % 90);
    const Recorded r = run(text + "M30\n", machine);
    EXPECT_TRUE(r.summary.run.limits_ok);
    EXPECT_LE(worst_share(r, machine), 1.0011);
}

/// A zigzag of ten lines that turn both axes.
FiveAxisPath zigzag(const Machine& machine, double length) {
    std::vector<FiveAxisChord> chords(10);
    for (std::size_t k = 0; k < chords.size(); ++k) {
        const double n = static_cast<double>(k + 1);
        chords[k].end << (k % 2 == 0 ? length : 0.0), 5 * n, 0, 0.02 * n, 0.1 * n;
        chords[k].feed = 50;
        chords[k].tolerance = 0.01;
        chords[k].block = static_cast<std::uint32_t>(k);
    }
    return {machine.kinematics, Vec3::Zero(), FiveAxes::Zero(), chords};
}

std::vector<FiveAxisMotion> plan_of(const FiveAxisPath& path, const Machine& machine) {
    return plan_speeds(path, machine, [](std::size_t) { return Place{}; });
}

TEST(FiveAxisSimulator, LongLinesCostNoMoreThanShortOnes) {
    const Machine machine = trunnion();
    const auto motions = [&](double length) {
        return static_cast<double>(plan_of(zigzag(machine, length), machine).size());
    };
    EXPECT_LT(motions(2000), 1.6 * motions(100));
}

/// The largest share of an axis' acceleration or jerk, or of the normal acceleration of the tip, at `places` of each motion:
/// by the chain rule, with b = v² and its derivatives by u.
double share_along(const FiveAxisPath& path, const Machine& machine, int places) {
    double worst = 0;
    for (const FiveAxisMotion& motion : plan_of(path, machine)) {
        for (int n = 0; n < places; ++n) {
            double u = motion.begin, b = 0, slope = 0, curve = 0;  // of b
            if (motion.jerk == 0) {
                const double at = motion.cell.length * n / places;
                u += at;
                curve = 2 * motion.cell.curve;
                slope = 2 * motion.cell.acceleration + curve * at;
                b = motion.cell.speed * motion.cell.speed + at * (slope + 2 * motion.cell.acceleration) / 2;
            } else {  // v = j t²/2 from or to a rest, so that b = (9/2)^(2/3) j^(2/3) d^(4/3) at the distance d = j t³/6
                double speed = 0;
                const double time = motion.duration * n / places;
                u = motion.at(time, speed);
                const double from_rest = motion.jerk > 0 ? time : motion.duration - time, j = std::abs(motion.jerk);
                if (!(from_rest > 0)) continue;
                b = speed * speed;
                slope = (motion.jerk > 0 ? 2 : -2) * j * from_rest;
                curve = 2 * j / speed;
            }
            PathDerivatives tip;
            const AxisSample<5> d = path.derivatives(u, tip);
            const double pace = tip.first.norm();  // pace of the tip, whose normal acceleration is (v pace)² / radius
            if (pace > 1e-9)
                worst = std::max(worst,
                                 b * tip.first.cross(tip.second).norm() / pace / machine.path.max_normal_acceleration);
            for (int k = 0; k < 5; ++k) {
                const MachineAxis& axis =
                    k < 3 ? machine.axes[static_cast<std::size_t>(k)] : machine.rotary[static_cast<std::size_t>(k - 3)];
                const double a = d.first[k] * slope / 2 + d.second[k] * b;
                const double j = (d.first[k] * curve / 2 + 1.5 * d.second[k] * slope + d.third[k] * b) * std::sqrt(b);
                worst = std::max({worst, std::abs(a) / axis.max_acceleration, std::abs(j) / axis.max_jerk});
            }
        }
    }
    return worst;
}

// Where lines nearly reverse, derivatives change within a thousandth of a millimetre: a limit met at five points of a
// cell is not met between them.
TEST(FiveAxisSimulator, LimitsHoldBetweenTheSamplesOfACell) {
    const Machine machine = trunnion();
    for (const double length : {100.0, 2000.0}) EXPECT_LE(share_along(zigzag(machine, length), machine, 64), 1.0005);
}

// A window of the plan would end at rest in a sharp bend, where no speeds meet the limits; slightly before it they do.
TEST(FiveAxisSimulator, AWindowDoesNotEndInABendThatAllowsNoRest) {
    std::ifstream file(SAMPLE_DATA "/programs/butterfly_nurbs.nc");
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const Program program = test::parse_text(text);
    const FiveAxisSummary summary =
        simulate_five_axis(program, trunnion(), Vec3::Zero(), Vec3::Zero(), [](std::span<const FiveAxisPoint>) {}, {});
    EXPECT_TRUE(summary.run.limits_ok);
    // The rotary axes do not move: the three-axis planner takes 5.778 s within the limits of the same linear axes.
    EXPECT_NEAR(summary.run.duration, 5.778, 0.05 * 5.778);
}

// A rest in the middle of a bend that is smaller than the distance that the jerk of a straight line to the rest would take:
// full circles
// of 0.002 to 0.02 mm at the end, and a line of 3 µm that nearly reverses before a dwell.
TEST(FiveAxisSimulator, ARestBesideATinyBendIsReached) {
    const Machine machine = trunnion();
    std::vector<std::string> programs{
        "G21 G90 G17 G64 P0.0007 F632.8\nG1 X-1.45737 Y1.7574\nG1 X-1.4948 Y1.7593 A-0.4655 C-0.0177\n"
        "G1 X-1.4937 Y1.7567 F5120.8\nG1 X-1.4706 Y1.7636\nG4 P0.037\nM2\n",
        "G21 G90 G17 G64 P0.0262 F610.8\nG1 X-0.0027 Y0.0012\nG1 X-0.02 Y0.001\nG1 X-0.003\nM2\n"};
    for (const char* radius : {"0.001", "0.002", "0.01", "0.02"})
        programs.push_back(fmt::format("G21 G17 G64 P0.005\nG1 X5 F2500\nG3 X5 Y0 J{}\nM2\n", radius));
    for (const std::string& program : programs) {
        const Recorded r = run(program, machine);
        EXPECT_TRUE(r.summary.run.limits_ok) << program;
        EXPECT_LE(worst_share(r, machine), 1.0011) << program;
    }
}

// Short lines that nearly reverse, on a machine whose axes take from 1.3 ms (a table of high jerk) to 0.55 s to reach their
// acceleration: no initial speeds led to a solution, and the program was refused.
TEST(FiveAxisSimulator, LimitsOfVeryDifferentAxesArePlanned) {
    Machine machine = trunnion();
    machine.controller.period = 0.004;
    machine.path = {machine.path.max_speed, 435.452, 6830.72, 9617.52};
    const std::array<std::array<double, 3>, 5> limits{
        {{3979.1, 10591.3, 19202.4},
         {1115.7, 37492.8, 152617},
         {872.04, 4792.17, 545319},
         {39.349 * rad_per_deg, 1401.03 * rad_per_deg, 70972.6 * rad_per_deg},
         {81.78 * rad_per_deg, 8833.52 * rad_per_deg, 1.1379e6 * rad_per_deg}}};
    for (std::size_t k = 0; k < 5; ++k) {
        MachineAxis& axis = k < 3 ? machine.axes[k] : machine.rotary[k - 3];
        axis.max_speed = limits[k][0], axis.max_acceleration = limits[k][1], axis.max_jerk = limits[k][2];
    }
    const Recorded r = run(
        "G21 G90 G17 G43.4 H1\nG64 P0.0297 F197\nG0 X-27.6086 Y-25.1345 Z11.5007 A-6.8278 C-21.9761\n"
        "G1 X-27.6639 Y-25.1914 Z11.5007 A-7.5913 C-23.4305\nG1 X-27.6635 Y-25.1911 Z11.5007 A-7.6302 C-23.4307\n"
        "G1 X-27.6681 Y-25.1958 Z11.5007 A-6.3905 C-22.1439 F194\nG1 X-27.6137 Y-25.1380 Z11.5007 A-8.4814 C-22.0743\nM2\n",
        machine);
    EXPECT_TRUE(r.summary.run.limits_ok);
    EXPECT_LE(worst_share(r, machine), 1.0011);
    EXPECT_LT(r.summary.run.duration, 5) << "4.3 s; the rapid alone takes 3.4 s";
}

// The chords of a curve are joined within a tolerance, but its bend is programmed: it affects the jerk of an axis. Spans of
// a spline are blocks, so a few points next to their joints remain; previously there were 57 of 3,009.
TEST(FiveAxisSimulator, ABendOfACurveIsNoCorner) {
    std::ifstream file(SAMPLE_DATA "/programs/butterfly_nurbs.nc");
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const Recorded r = run(text, trunnion());
    EXPECT_LE(std::ranges::count(r.points, LimitingFactor::corner_tolerance, &FiveAxisPoint::limit), 5);
    EXPECT_GT(std::ranges::count(r.points, LimitingFactor::jerk, &FiveAxisPoint::limit), 1000);
}

TEST(FiveAxisSimulator, FeedOfZeroNamesTheLine) {
    try {
        (void)run("G43.4 H1\nG1 X10 A-5 F0\n", trunnion());
        FAIL();
    } catch (const InputError& error) { EXPECT_EQ(error.diagnostic().where.number, 2u); }
}

}  // namespace
}  // namespace clsurf::five_axis_simulator_test
