// Five axes: positions through the kinematics, lines found without a line channel with tool centre point
// control and without, tool axes given as vectors.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "mapping/line_map.h"
#include "mapping/map_lines.h"
#include "support/made_five_axis.h"
#include "toolpath/tip_motions.h"
#include "toolpath/toolpath.h"

namespace clsurf::five_axis_test {
namespace {

const Vec3 zero(12, -7, 31);  ///< machine position of the programs' zero

/// Axis positions: a face milled at A-30 C45, with an arc, then a move with both axes turning.
std::string tilted_program() {
    std::string text = "G21 G90 G54\nG0 X0 Y0 Z50\nG0 A-30 C45\nG0 Z5\nG1 Z0 F1500\n";
    for (int pass = 0; pass < 6; ++pass) {
        text += fmt::format("G1 X{}\n", pass % 2 == 0 ? 30 : 0);
        text += fmt::format("G1 Y{}\n", 2 * (pass + 1));
    }
    text += "G2 X10 Y22 I5 J5\nG1 X20 Y25\nG1 X30 Y20 A-10 C75\nG1 X0 Y5 A-45 C20\nG0 Z50\nM30\n";
    return text;
}

double right_share(Program program, const Kinematics& kinematics) {
    test::MadeLog made = test::run(program, kinematics, zero, 0.05);
    made.finish(0.001);
    make_tip_motions(program, kinematics, -zero, Vec3::Zero());
    const Trajectory path = reconstruct(made.log, Role::commanded, -zero, std::make_shared<Kinematics>(kinematics));
    Diagnostics diagnostics;
    const LineMap lines = map_lines(path, made.log, program, false, diagnostics);
    EXPECT_EQ(diagnostics.count("map.lost"), 0u);
    std::int64_t right = 0;
    for (PointIndex i = 0; i < path.count; ++i) {
        right += std::abs(static_cast<double>(lines.line_at(i)) - made.line[static_cast<std::size_t>(i)]) <= 1 ? 1 : 0;
    }
    return static_cast<double>(right) / static_cast<double>(path.count);
}

TEST(FiveAxisLines, FoundUnderToolCentrePointControl) {
    EXPECT_GE(right_share(test::parse_text(test::dome_program()), test::trunnion()), 0.995);
}

TEST(FiveAxisLines, FoundWithPositionsOfTheAxes) {
    EXPECT_GE(right_share(test::parse_text(tilted_program()), test::trunnion()), 0.995);
}

TEST(FiveAxisLines, FoundOnAForkHead) {
    Kinematics k;
    k.type = KinematicsType::head_head;
    k.tilt = {'a', Vec3::UnitX(), -1};
    k.tilt_from_rotation = {0.3, 0, 5};
    k.tool_length = 180;
    EXPECT_GE(right_share(test::parse_text(test::dome_program()), k), 0.995);
    EXPECT_GE(right_share(test::parse_text(tilted_program()), k), 0.995);
}

// Axis positions with A at −90°: the program's Z is the workpiece's depth from the side. By hand for a
// machine whose axes all pass through its zero: T(−A) about x by +90° maps (x, y, z) to (x, −z, y), so
// that the tip at (1, 2, 3) of the workpiece has axis positions (1, −3, 2), and back.
TEST(FiveAxisLines, PositionsOfTheAxesBecomeTips) {
    Kinematics k;
    k.type = KinematicsType::table_table;
    Program program = test::parse_text("G21 G90\nG0 X0 Y0 Z0 A-90\nG1 X1 Y-3 Z2 F100\nM30\n");
    ASSERT_EQ(program.motions.size(), 2);
    make_tip_motions(program, k, Vec3::Zero(), Vec3::Zero());
    const Vec3 end = program.motions.end[program.motions.end.size() - 1].vec();
    EXPECT_LE((end - Vec3(1, 2, 3)).norm(), 1e-12) << end.transpose();
    // A quarter turn consists of chords; the last line is one motion.
    EXPECT_EQ(program.motions.size(), 180 + 1);
    EXPECT_EQ(program.motions.line[180], 3u);
}

/// The time of the tip paths of a line at their feeds [s].
double time_of_line(const Program& program, LineNumber line) {
    const Toolpath path(program.motions, Vec3::Zero());
    double time = 0;
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const auto at = static_cast<std::size_t>(m);
        if (program.motions.line[at] == line) time += path.length(m) / program.motions.feed[at];
    }
    return time;
}

// C turns about the workpiece's zero, with the tip 10 mm off it. Under G93 a line takes 1/F minutes, wherever the tip goes.
// For a line that only turns, F counts degrees: 90° at 360 deg/min are 15 s, though the tip moves 15.7 mm. With X in it, F is
// that of the tip.
TEST(FiveAxisLines, ATurnTakesTheTimeOfItsFeed) {
    Kinematics k;
    k.type = KinematicsType::table_table;
    for (const char* units : {"G21 X10", "G20 X0.393700787402"}) {
        Program program =
            test::parse_text(std::string("G90 ") + units +
                             " G0 Y0 Z0 A0 C0\nG1 C90 F360\nG93 G1 C0 F2\nG1 X0.4 C90 F4\nG94 X0.5 F60\nM30\n");
        make_tip_motions(program, k, Vec3::Zero(), Vec3::Zero());
        EXPECT_NEAR(time_of_line(program, 2), 15, 1e-3) << units;
        EXPECT_NEAR(time_of_line(program, 3), 30, 1e-3) << units;
        EXPECT_NEAR(time_of_line(program, 4), 15, 1e-3) << units;
        EXPECT_TRUE(program.diagnostics.empty()) << units;
    }
}

// A ball of 3 mm whose axis is (0, 1, 0), tip at (1, 2, 3): its centre is (1, 5, 3), its lowest point (1, 5, 0). The tool is
// upright
// before that, and nothing changes.
TEST(UprightBall, HasTheSameCentre) {
    const Kinematics k = test::trunnion();
    test::MadeLog made = test::run(test::parse_text("G21 G90\nG43.4 H1\nG1 X1 Y2 Z3 F100\nA-90\nM30\n"), k, zero, 0.05);
    made.finish(0.001);
    const Trajectory tips = reconstruct(made.log, Role::commanded, -zero, std::make_shared<Kinematics>(k));
    const Trajectory upright = upright_ball(made.log, tips, 3);
    EXPECT_LE((upright.at(0) - tips.at(0)).norm(), 1e-12);
    EXPECT_LE((tips.at(tips.count - 1) - Vec3(1, 2, 3)).norm(), 1e-9);
    EXPECT_LE((upright.at(upright.count - 1) - Vec3(1, 5, 0)).norm(), 1e-9)
        << upright.at(upright.count - 1).transpose();
    EXPECT_TRUE(tilts(made.log, tips));
}

TEST(FiveAxisLines, EventsStayBeforeTheirMotions) {
    Kinematics k;
    k.type = KinematicsType::table_table;
    Program program = test::parse_text("G21 G90\nG0 X0 Y0 Z0 A-90\nG43.4 H1\nG1 X1 F100\nG49\nG1 X2\nM30\n");
    make_tip_motions(program, k, Vec3::Zero(), Vec3::Zero());
    ToolCentrePoint control(program);
    for (std::int64_t m = 0; m < program.motions.size(); ++m)
        EXPECT_EQ(control.on(m), program.motions.line[static_cast<std::size_t>(m)] == 4);
}

TEST(ToolCentrePoint, IsSwitchedByTheWordsOfEachDialect) {
    const auto states = [](const Program& p) {
        std::string text;
        ToolCentrePoint control(p);
        for (std::int64_t m = 0; m < p.motions.size(); ++m) text += control.on(m) ? '1' : '0';
        return text;
    };
    EXPECT_EQ(states(test::parse_text("G0 X1\nG43.4 H1\nG1 X2 F9\nG49\nX3\nG43.5 H1\nX4\nG43 H1\nX5\n")), "01010");
    EXPECT_EQ(states(test::parse_text("G0 X1\nTRAORI\nG1 X2 F9\nTRAFOOF\nX3\nTRAORI(1)\nX4\n", "siemens")), "0101");
    EXPECT_EQ(states(test::parse_text("%1 G71\nN1 G0 X+1\nN2 M128\nN3 G1 X+2 F9\nN4 M129\nN5 X+3\n", "heidenhain-iso")),
              "010");
}

// The tool axis (0.6, 0, 0.8): tilt B of atan2(0.6, 0.8), C 0; or A of the same and C of atan2(0.6, −0) = 90°.
TEST(ToolAxisVectors, BecomeAngles) {
    Machine machine;
    machine.kinematics = test::trunnion();
    for (const auto& [text, dialect] :
         {std::pair{"G90 G0 X0 Y0 Z0\nG43.5 H1\nG1 X1 I0.6 J0 K0.8 F100\nX2\nX3 A0 C0\nM30\n", "fanuc"},
          std::pair{"G90 G0 X0 Y0 Z0\nTRAORI\nG1 X1 A3=3 B3=0 C3=4 F100\nX2\nX3 A0 C0\nM30\n", "siemens"}}) {
        Program program = test::parse_text(text, dialect);
        EXPECT_TRUE(program.diagnostics.empty()) << dialect;
        solve_tool_axes(program, machine);
        const Motions& m = program.motions;
        ASSERT_EQ(m.size(), 4) << dialect;
        for (const std::size_t i : {1u, 2u}) {
            const RotaryAngles angles = machine.kinematics.angles_of(m.rotary[i].vec());
            EXPECT_NEAR(std::abs(angles.tilt), std::atan2(0.6, 0.8), 1e-12) << dialect;
            EXPECT_LE(angle_between(machine.kinematics.axis_of(angles), {0.6, 0, 0.8}), 1e-12) << dialect;
        }
        EXPECT_EQ(m.rotary[3], Xyz(0, 0, 0)) << dialect;
    }
}

// A plane rotated by 90° about X: programmed (x, y, z) is (x, −z, y) of the workpiece, its normal (0, −1, 0). The
// trunnion's axis is (sin A sin C, −sin A cos C, cos A): A 90 C 0 (or A −90 C 180). If all axes pass through the zero,
// the axis positions of the tip (1, −3, 2) are T(−90°) about x of it, (1, 2, 3): the axes show the coordinates
// of the program in the plane.
TEST(TiltedPlanes, AreWaysOfTheTipWithTheToolUprightOnThem) {
    Kinematics k;
    k.type = KinematicsType::table_table;
    for (
        const auto& [text, dialect] :
        {std::pair{
             "G90 G21\nG0 X0 Y0 Z0\nG68.2 X0 Y0 Z0 I0 J90 K0\nG53.1\nG1 X1 Y2 Z3 F100\nX2\nG69\nG0 X7 Y8 Z9\nA0 C0\nM30\n",
             "fanuc"},
         std::pair{
             "G90 G71\nG0 X0 Y0 Z0\nCYCLE800(0,\"TC\",100000,57,0,0,0,90,0,0,0,0,0,1)\nG1 X1 Y2 Z3 F100\nX2\nCYCLE800()\nG0 X7 Y8 Z9\nA0 C0\nM30\n",
             "siemens"}}) {
        Program program = test::parse_text(text, dialect);
        EXPECT_TRUE(program.diagnostics.empty()) << dialect;
        solve_tool_axes(program, k);
        ASSERT_EQ(program.motions.size(), 6) << dialect;
        const Motions& m = program.motions;
        EXPECT_LE((m.end[2].vec() - Vec3(1, -3, 2)).norm(), 1e-12) << dialect;
        for (const std::size_t i : {1u, 2u, 3u})
            EXPECT_LE(angle_between(k.axis_of(k.angles_of(m.rotary[i].vec())), {0, -1, 0}), 1e-12) << dialect << i;
        EXPECT_EQ(m.rotary[4], m.rotary[3]) << dialect;  // G69 does not turn the axes back
        EXPECT_EQ(m.rotary[5], Xyz(0, 0, 0)) << dialect;
        const LineNumber after = m.line[4];
        make_tip_motions(program, k, Vec3::Zero(), Vec3::Zero());
        ToolCentrePoint control(program);
        std::int64_t in_plane = 0;
        Vec3 axes = Vec3::Zero();  // end of the last motion of the line after the plane: axis positions again
        for (std::size_t i = 0; i < m.kind.size(); ++i) {
            in_plane += control.on(static_cast<std::int64_t>(i)) ? 1 : 0;
            if (m.line[i] == after) axes = k.to_axes(m.end[i].vec(), k.angles_of(m.rotary[i].vec()));
        }
        EXPECT_EQ(in_plane, 2) << dialect;  // the turn before them is a motion of the axes, in separate chords
        EXPECT_LE((axes - Vec3(7, 8, 9)).norm(), 1e-9) << dialect;
    }
}

// The same machine: computed by hand, the axes show the coordinates of the program in the plane, so that the log is the
// zigzag itself,
// with A at 90°; after the plane, at A 0, the same numbers are another place of the workpiece.
TEST(TiltedPlanes, GiveTheirPointsTheirLines) {
    Kinematics k;
    k.type = KinematicsType::table_table;
    std::string zigzag;
    for (int pass = 0; pass < 8; ++pass)
        zigzag += fmt::format("X{} Y{} Z1\nY{}\n", pass % 2 == 0 ? 30 : 2, pass, pass + 1);
    const std::string fanuc = "G90 G21\nG0 X0 Y0 Z60\nG68.2 X0 Y0 Z0 I0 J90 K0\nG53.1\nG0 X2 Y0 Z20\nG1 Z1 F2000\n" +
                              zigzag + "G0 Z60\nG69\nA0 C0\nG0 X2 Y0 Z20\nG1 Z1 F2000\n" + zigzag + "M30\n";
    std::string siemens = fanuc;
    siemens.replace(siemens.find("G21"), 3, "G71");
    siemens.replace(siemens.find("G68.2"), std::string_view("G68.2 X0 Y0 Z0 I0 J90 K0\nG53.1").size(),
                    "CYCLE800(0,\"TC\",100000,57,0,0,0,90,0,0,0,0,0,1)\n");
    siemens.replace(siemens.find("G69"), 3, "CYCLE800()");
    for (const auto& [text, dialect] : {std::pair{fanuc, "fanuc"}, std::pair{siemens, "siemens"}}) {
        test::MadeLog made;
        LineNumber number = 0;
        Vec3 at(2, 0, 1);
        double tilt = 90 * rad_per_deg;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (line == "A0 C0") {
                tilt = 0;
                at = Vec3(2, 0, 1);
            }
            const bool wide = line.starts_with("X"), narrow = line.starts_with("Y");
            if (!wide && !narrow) continue;
            Vec3 to = at;
            if (wide) to.x() = std::stod(line.substr(1));
            if (narrow) to.y() = std::stod(line.substr(1));
            for (int i = 1; i <= 100; ++i) made.add(at + 0.01 * i * (to - at), {tilt, 0}, number);
            at = to;
        }
        made.finish(0.001);
        Program program = test::parse_text(text, dialect);
        solve_tool_axes(program, k);
        make_tip_motions(program, k, Vec3::Zero(), Vec3::Zero());
        const Trajectory path = reconstruct(made.log, Role::commanded, Vec3(0, 0, 0), std::make_shared<Kinematics>(k));
        Diagnostics diagnostics;
        const LineMap map = map_lines(path, made.log, program, false, diagnostics);
        EXPECT_TRUE(map.match().foreign.empty()) << dialect << map.match().foreign;
        std::int64_t right = 0;
        for (PointIndex i = 0; i < path.count; ++i)
            right +=
                std::abs(static_cast<double>(map.line_at(i)) - made.line[static_cast<std::size_t>(i)]) <= 1 ? 1 : 0;
        EXPECT_GE(static_cast<double>(right), 0.99 * static_cast<double>(path.count)) << dialect;
    }
}

TEST(ToolAxisVectors, OutOfReachNamesTheLine) {
    Machine machine;
    machine.kinematics = test::trunnion();
    Program program = test::parse_text("G90 G0 X0 Y0 Z0\nG43.5 H1\nG1 X1 I0.6 K0.8 F100\nX2 I0 J0 K-1\nM30\n");
    try {
        solve_tool_axes(program, machine);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("cannot be reached"), std::string::npos);
        EXPECT_EQ(error.diagnostic().where.number, 4u);
    }
}

TEST(Poles, AreNoted) {
    const Kinematics k = test::trunnion();
    test::MadeLog made;
    for (int i = -100; i <= 100; ++i) made.add(Vec3::Zero(), {std::abs(i) * 0.001, i < 0 ? 0 : std::numbers::pi}, 1);
    made.finish(0.001);
    Diagnostics diagnostics;
    note_poles(made.log, Role::commanded, k, diagnostics);
    EXPECT_EQ(diagnostics.count("path.pole"), 1u);
    const Trajectory path = reconstruct(made.log, Role::commanded, Vec3::Zero(), std::make_shared<Kinematics>(k));
    for (PointIndex i = 0; i < path.count; ++i) ASSERT_TRUE(path.at(i).allFinite());
}

TEST(FiveAxisPositions, NeedTheRotaryChannels) {
    test::MadeLog made;
    made.add(Vec3::Zero(), {}, 1);
    made.finish(0.001);
    std::erase_if(made.log.channels, [](const Channel& c) { return c.name == "cmd.c"; });
    EXPECT_THROW(
        (void)reconstruct(made.log, Role::commanded, Vec3::Zero(), std::make_shared<Kinematics>(test::trunnion())),
        InputError);
}

}  // namespace
}  // namespace clsurf::five_axis_test
