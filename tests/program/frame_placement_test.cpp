// Combined work frames: every position is computed by hand as machine = tool + offset + rotated (word + G92).

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/units.h"
#include "program/frame_placement.h"
#include "program/motion_rows.h"
#include "program/program_reader.h"

namespace clsurf::frame_placement_test {
namespace {

Rows placed(const std::string& text, const char* dialect, Coordinates coordinates, const FramePoses& poses = {}) {
    Program program = parse(text, dialect);
    place_motions(program, poses, coordinates);
    return motions(program);
}
Rows on_machine(const std::string& text, const char* dialect = "linuxcnc") {
    return placed(text, dialect, Coordinates::machine);
}
Rows on_workpiece(const std::string& text, const char* dialect = "linuxcnc", const FramePoses& poses = {}) {
    return placed(text, dialect, Coordinates::workpiece, poses);
}

TEST(WorkFrames, AProgramWithoutOffsetsHasOne) {
    const Program program = parse("G21 G90\nG0 X0 Y0 Z5\nG1 X20 F3000\nM2\n", "linuxcnc");
    EXPECT_TRUE(program.motions.frame.empty());
    EXPECT_EQ(program.motions.frames.size(), 1u);
    EXPECT_EQ(unknown_systems(program.motions), std::vector<int>{1});
}

TEST(WorkFrames, AnotherSystemLiesWhereItsOffsetPutsIt) {
    const char* text = "G21 G90\nG10 L2 P2 X100\nG54 G0 X0 Y0 Z5\nG1 X20 F3000\nG55\nG1 X0\nM2\n";
    EXPECT_EQ(on_machine(text), (Rows{"rapid 0 0 5", "feed 20 0 5", "feed 100 0 5"}));
    EXPECT_EQ(motions(parse(text, "linuxcnc")), (Rows{"rapid 0 0 5", "feed 20 0 5", "feed 0 0 5"}));
}

TEST(WorkFrames, AShiftOfThePositionMovesNothing) {
    // X 82 Y 10 becomes zero: the plunge is 5 mm long, and the workpiece's zero is there.
    const char* text = "G21 G90\nG0 X82 Y10 Z5\nG92 X0 Y0\nG1 Z0 F100\nX10\nM2\n";
    EXPECT_EQ(on_machine(text), (Rows{"rapid 82 10 5", "feed 82 10 0", "feed 92 10 0"}));
    EXPECT_EQ(on_workpiece(text), (Rows{"rapid 0 0 5", "feed 0 0 0", "feed 10 0 0"}));
}

TEST(WorkFrames, ASystemIsTurnedAboutItsZero) {
    // R 90: X 5 of the work system is Y 5 of the machine. An arc in the plane remains an arc.
    const char* text = "G21 G90\nG10 L2 P1 X10 Y0 Z0 R90\nG54 G0 X0 Y0 Z0\nG1 X5 F600\nG2 X10 I2.5\nM2\n";
    EXPECT_EQ(on_machine(text), (Rows{"rapid 10 0 0", "feed 10 5 0", "cw 10 10 0"}));
    EXPECT_EQ(on_workpiece(text), (Rows{"rapid 0 0 0", "feed 5 0 0", "cw 10 0 0"}));
    Program program = parse(text, "linuxcnc");
    place_motions(program, {}, Coordinates::machine);
    ASSERT_EQ(program.motions.arcs.size(), 1u);
    EXPECT_NEAR(program.motions.arcs[0].centre.x, 10, 1e-12);
    EXPECT_NEAR(program.motions.arcs[0].centre.y, 7.5, 1e-12);
}

TEST(WorkFrames, MotionsAreNotPlacedTwice) {
    Program program = parse("G21 G90\nG10 L2 P2 X100\nG55 G0 X0 Y0 Z5\nG1 X20 F3000\nM2\n", "linuxcnc");
    place_motions(program, {}, Coordinates::machine);
    EXPECT_THROW(place_motions(program, {}, Coordinates::machine), std::logic_error);
}

TEST(WorkFrames, SystemsShiftsAndRotationsTogether) {
    // machine = G55 + rotated by 30° (word + G92): cos 30° = 0.866025.
    const char* text =
        "G21 G90 G17\nG10 L2 P1 X5 Y-3 Z2\nG10 L2 P2 X120 Y30 Z-4 R30\nG54 F2500\nG1 X20 Y0 Z0\nG55\nG1 X20 Y5 Z0\n"
        "X0 Y0\nG92 X3 Y4\nX10 Y10\nM2\n";
    Program program = parse(text, "linuxcnc");
    place_motions(program, {}, Coordinates::machine);
    const std::vector<Vec3> ends{{25, -3, 2}, {134.820508, 44.330127, -4}, {120, 30, -4}, {123.062178, 38.696152, -4}};
    ASSERT_EQ(program.motions.end.size(), ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i) EXPECT_LT((program.motions.end[i].vec() - ends[i]).norm(), 1e-5) << i;
}

TEST(WorkFrames, ATurnedArcOfG18BecomesChordsOnItsCircle) {
    Program program = parse("G21 G90 G18\nG10 L2 P1 R30\nG54 G0 X0 Y0 Z0\nG2 X10 Z0 I5 F600\nG1 X20\nM2\n", "linuxcnc");
    const std::int64_t before = program.motions.size();
    const std::size_t events = program.events.size();
    place_motions(program, {}, Coordinates::machine);
    const Motions& m = program.motions;
    ASSERT_GT(m.size(), before + 10);
    EXPECT_TRUE(m.arcs.empty());
    EXPECT_EQ(program.events.size(), events);
    // Centre (5, 0, 0), rotated by 30°.
    const Vec3 centre(5 * std::cos(30 * rad_per_deg), 2.5, 0);
    for (std::int64_t i = 1; i + 1 < m.size(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_EQ(m.kind[at], MotionKind::spline);
        EXPECT_EQ(m.line[at], 4u);
        EXPECT_NEAR((m.end[at].vec() - centre).norm(), 5, 1e-9);
        const Vec3 middle = 0.5 * (m.end[at].vec() + m.begin_of(i).vec());
        EXPECT_NEAR((middle - centre).norm(), 5, 1.1e-3);
    }
    EXPECT_NEAR(m.end[static_cast<std::size_t>(m.size() - 1)].x, 20 * std::cos(30 * rad_per_deg), 1e-9);
}

TEST(WorkFrames, FanucAndSiemensFramesAreInsideTheirWorkSystem) {
    // G55 at Y 50 by G10; G68 rotates by 90° about the work zero; G52 shifts.
    EXPECT_EQ(
        on_machine(
            "G21 G90\nG10 L2 P2 X0 Y50 Z0\nG55 G0 X0 Y0 Z0\nG68 X0 Y0 R90\nG1 X5 F600\nG69\nG52 X1\nG1 X0 Y0\nM30\n",
            "fanuc"),
        (Rows{"rapid 0 50 0", "feed 0 55 0", "feed 1 50 0"}));
    EXPECT_EQ(on_machine("G21 G90\nG10 L20 P1 X7 Y0 Z0\nG54.1 P1 G0 X0 Y0 Z0\nM30\n", "fanuc"), (Rows{"rapid 7 0 0"}));
    EXPECT_EQ(on_machine("G71 G90\nG54 G0 X0 Y0 Z0\nTRANS X10\nAROT RPL=90\nG1 X5 Y0 F600\nM30\n", "siemens"),
              (Rows{"rapid 0 0 0", "feed 10 5 0"}));
}

TEST(WorkFrames, APoseFromOutsideMovesOnlyWhatTheProgramLeavesOpen) {
    // G54 is at X −300 Z −400 of the machine; G55 is set to X 100 of the machine, Y and Z to 0: 400 away from it.
    FramePoses poses;
    poses.zero = pose_of(Vec3(-300, 0, -400), 0);
    EXPECT_EQ(on_workpiece("G21 G90\nG10 L2 P2 X100 Y0 Z0\nG54 G0 X0 Y0 Z5\nG1 X20 F300\nG55 G1 X0 Y0 Z-400\nM2\n",
                           "linuxcnc", poses),
              (Rows{"rapid 0 0 5", "feed 20 0 5", "feed 400 0 0"}));
    // The zero of the machine is 400 above; Z stays there until a word moves it.
    EXPECT_EQ(on_workpiece("G21 G90\nG53 G0 Z0\nG0 X1 Y1\nZ5\nG1 Z0 F100\nX2\nM2\n", "linuxcnc", poses),
              (Rows{"rapid 0 0 400", "rapid 1 1 400", "rapid 1 1 5", "feed 1 1 0", "feed 2 1 0"}));
}

TEST(WorkFrames, AMachineMayStandAnywhereBeforeTheProgram) {
    FramePoses poses;
    poses.starts_anywhere = true;
    EXPECT_EQ(on_workpiece("G21 G90\nG0 Z5\nG0 X0\nY0\nG1 Z0 F100\nX2\nM2\n", "linuxcnc", poses),
              (Rows{"rapid nan nan 5", "rapid 0 nan 5", "rapid 0 0 5", "feed 0 0 0", "feed 2 0 0"}));
}

TEST(WorkFrames, ASystemOfItsOwnPoseIsNamed) {
    FramePoses poses;
    poses.zero = pose_of(Vec3(10, 0, 0), 0);
    const char* text = "G21 G90\nG54 G0 X0 Y0 Z5\nG1 X20 F300\nG55 G1 X0 Y0\nM2\n";
    // If it is not named, G55 is at the position of G54.
    EXPECT_EQ(on_workpiece(text, "linuxcnc", poses), (Rows{"rapid 0 0 5", "feed 20 0 5", "feed 0 0 5"}));
    poses.systems[2] = pose_of(Vec3(110, 0, 0), 90);
    EXPECT_EQ(on_workpiece(text, "linuxcnc", poses), (Rows{"rapid 0 0 5", "feed 20 0 5", "feed 100 0 5"}));
    EXPECT_EQ(unknown_systems(parse(text, "linuxcnc").motions), (std::vector<int>{1, 2}));
}

TEST(WorkFrames, ALogThatIsDisplacedTakesAllSystemsAlong) {
    // The program sets both; the log counts from the zero of G54.
    FramePoses poses;
    poses.zero = pose_of(Vec3::Zero(), 0);
    EXPECT_EQ(on_workpiece("G21 G90\nG10 L2 P1 X100\nG10 L2 P2 X150\nG54 G0 X0 Y0 Z5\nG1 X20 F300\nG55 G1 X0\nM2\n",
                           "linuxcnc", poses),
              (Rows{"rapid 0 0 5", "feed 20 0 5", "feed 50 0 5"}));
}

TEST(WorkFrames, AProgramInPiecesIsOnTheMachineToo) {
    std::string text = "G21 G90\nG10 L2 P2 X100 R90\nG54 G0 X0 Y0 Z5\nG1 X20 F3000\n";
    for (int i = 0; i < 50; ++i) text += "G55 X" + std::to_string(i) + "\nG54 X" + std::to_string(i) + " Y1\nG92.1\n";
    const Rows whole = on_machine(text);
    InterpreterOptions options;
    options.dialect = find_dialect("linuxcnc");
    const auto kept = std::make_shared<std::string>(text);
    ProgramReader reader(SourceText("test.nc", *kept, kept), options, 7);
    Rows pieces;
    while (reader.next_piece()) {
        Rows piece = motions(reader.program());
        pieces.insert(pieces.end(), piece.begin(), piece.begin() + reader.piece_size());
    }
    EXPECT_EQ(pieces, whole);
    EXPECT_EQ(reader.outline().motions, static_cast<std::int64_t>(whole.size()));
}

}  // namespace
}  // namespace clsurf::frame_placement_test
