// What may be rewritten; everything else is kept byte for byte.

#include <gtest/gtest.h>

#include "program/frame_placement.h"
#include "program/interpreter.h"
#include "program/motion_rows.h"
#include "repair/line_edit.h"
#include "repair/parts.h"

namespace clsurf::line_edit_test {
namespace {

TEST(PlainLine, IsNumberG1AndAxesOnly) {
    EXPECT_TRUE(read_plain_line("X1.5 Y-2.").has_value());
    EXPECT_TRUE(read_plain_line("N10 G01 X1.5Y2Z3.000").has_value());
    EXPECT_TRUE(read_plain_line("n10g1x=1.5").has_value());
    for (const char* text :
         {"", "N10", "G1", "G0 X1", "G1 X1 F100", "X1 (edge)", "X1 ; edge", "X#1", "A5", "X1 A3=0.1", "X1 I0 J0 K1",
          "X1 C=DC(5)", "X1 M8", "G1 G41 X1", "X1 X2", "X", "G1.1 X1", "/X1", "X1 G1"}) {
        EXPECT_FALSE(read_plain_line(text).has_value()) << text;
    }
    const PlainLine line = *read_plain_line("N10 G1 X1.250 Z=-3");
    EXPECT_EQ(line.number, "N10 ");
    EXPECT_EQ(line.code, "G1 ");
    EXPECT_EQ(line.decimals[0], 3);
    EXPECT_EQ(line.axis[2], "Z=");
    EXPECT_EQ(line.value[2], -3);
    const PlainLine turning = *read_plain_line("X1. A-16.4010 C=117.69");
    EXPECT_EQ(turning.axis[5], "C=");
    EXPECT_EQ(turning.digits[3], "-16.4010");
    EXPECT_EQ(turning.decimals[5], 2);
    EXPECT_EQ(turning.value[3], -16.401);
}

constexpr const char* part =
    "%\r\nO1000 (PART)\r\n( ROUGH )\r\nG21 G90\r\nG0 X0 Y0 Z5.\r\nN10 G1 X1.000 F600 (ENTRY)\r\nN20 X2.000\r\nN30 X3.000\r\nN40 X4.000 Y0.500\r\nN50 X5.000\r\nM8\r\nN60 X6.000\r\nM2\r\n%";

std::vector<std::int64_t> editable(const Program& program) {
    const LineEditor editor(program);
    std::vector<std::int64_t> motions;
    for (std::int64_t i = 0; i < program.motions.size(); ++i) {
        if (editor.editable(i)) motions.push_back(i);
    }
    return motions;
}

TEST(LineEditor, LeavesLinesWithMoreInThemAlone) {
    const Program program = read_text(part);
    EXPECT_EQ(editable(program), (std::vector<std::int64_t>{2, 3, 4, 5, 6}));
    EXPECT_TRUE(editable(read_text("G91\nG0 X1\nG1 X1 F100\nX2\nX2\n")).empty())
        << "incremental words do not say where they go";
    EXPECT_EQ(editable(read_text("G0 X0 Y0 Z0\nG1 X1 F100\nX2 A5\nX2 A6\nX3 A7\n")), (std::vector<std::int64_t>{2, 4}))
        << "a turn in place has to stay";
    EXPECT_EQ(editable(read_text("G0 X0 Y0 Z0\nG1 X1 F100\nX2\nG93 X3 F2\nX4\nG95 X5 F0.1\nX6\nG94 X7 F100\nX8\n")),
              (std::vector<std::int64_t>{2, 8}))
        << "F counts something else than lengths per minute";
}

// Klartext has L on every line and a sign before every number; a feed alone is a block L F.
TEST(LineEditor, WritesKlartext) {
    const PlainLine line = *read_plain_line("12 L X+1.50 Y-2", "L");
    EXPECT_EQ(line.number, "12 ");
    EXPECT_EQ(line.code, "L ");
    EXPECT_EQ(line.value[0], 1.5);
    for (const char* text :
         {"12 X+1", "12 LN X+1", "12 L X+1 R0", "12 L X+1 FMAX", "12 L IX+1", "12 L X+Q1", "L", "12 L"})
        EXPECT_FALSE(read_plain_line(text, "L").has_value()) << text;
    InterpreterOptions options;
    options.dialect = find_dialect("klartext");
    const auto text = std::make_shared<std::string>(
        "0 BEGIN PGM A MM\n1 L X+0 Y+0 Z+0 R0 FMAX\n2 L X+1 F600\n3 L X+2.00\n4 L X+3.00\n5 L M30\n6 END PGM A MM\n");
    const Program program = parse_program(SourceText("a.h", *text, text), options);
    EXPECT_EQ(editable(program), (std::vector<std::int64_t>{2, 3}));
    LineEditor points(program);
    EXPECT_EQ(points.replace(2, 3, {Vec3(1.5, 0, 0), Vec3(2.25, -0.25, 0), Vec3(3, 0, 0)}), 3u);
    EXPECT_NE(points.text("smoothed").find("MM\n; smoothed\n1 L"), std::string::npos) << points.text("smoothed");
    EXPECT_NE(points.text("").find("3 L X+1.50\nL X+2.25 Y-0.25\n4 L X+3.00 Y+0.00\n5 L M30"), std::string::npos)
        << points.text("");
    LineEditor feeds(program);
    feeds.set_feeds({0, 0, 5, 5});
    EXPECT_NE(feeds.text("").find("3 L X+2.00 F300\n4 L X+3.00\nL F600\n5 L M30"), std::string::npos) << feeds.text("");
}

// Rotated by 90° and 100 away: X 1.5 of the work system is Y 1.5 of the machine, where the points come from.
TEST(LineEditor, WritesInTheFrameThatIsActive) {
    InterpreterOptions options;
    options.dialect = find_dialect("linuxcnc");
    const auto text = std::make_shared<std::string>(
        "G21 G90\nG10 L2 P2 X100 Y0 Z0 R90\nG55 G0 X0 Y0 Z0\nG1 X1.000 F600\nX2.000\nX3.000\nM2\n");
    Program program = parse_program(SourceText("part.ngc", *text, text), options);
    place_motions(program, {}, Coordinates::machine);
    EXPECT_EQ(editable(program), (std::vector<std::int64_t>{2, 3}));
    LineEditor editor(program);
    EXPECT_EQ(editor.replace(2, 3, {Vec3(100, 1.5, 0), Vec3(99.75, 2.25, 0), Vec3(100, 3, 0)}), 3u);
    const std::string written = editor.text("");
    EXPECT_NE(written.find("X1.000 F600\nX1.500\nX2.250Y0.250\nX3.000Y0.000\nM2"), std::string::npos) << written;
}

// Three lines become four: the words of an old point are kept, others have the finest decimals of the program.
// Rotated by 90° about (0, 0), then shifted or scaled: computed by hand for each control.
TEST(LineEditor, WritesWhatIsTurnedShiftedAndScaledAsTheProgramCountsIt) {
    struct Case {
        const char *dialect, *frame, *end;
        Vec3 at;  ///< position of X1.5 Y0 in these frames
    };
    const Case cases[] = {{"fanuc", "G68 X0 Y0 R90", "G69", {0, 1.5, 0}},
                          {"fanuc", "G52 X10 Y20", "G52 X0 Y0", {11.5, 20, 0}},
                          {"fanuc", "G51 X0 Y0 Z0 I3000 J1000 K1000", "G50", {4.5, 0, 0}},
                          {"fanuc", "G51.1 X5", "G50.1 X0", {8.5, 0, 0}},
                          {"siemens", "TRANS X10\nAROT RPL=90", "TRANS", {10, 1.5, 0}},
                          {"siemens", "ASCALE X2 Y2 Z2", "TRANS", {3, 0, 0}}};
    for (const Case& c : cases) {
        const std::string head = std::string("G0 X0 Y0 Z0\n") + c.frame + "\nG0 X0 Y0\n";
        const std::string tail = std::string(c.end) + "\nM30\n";
        Program program = parse(head + "G1 X1.000 F600\nX2.000\nX3.000\n" + tail, c.dialect);
        place_motions(program, {}, Coordinates::level);
        LineEditor editor(program);
        const std::int64_t last = program.motions.size() - 1;
        ASSERT_TRUE(editor.editable(last) && editor.editable(last - 1)) << c.frame;
        const Vec3 end = program.motions.end[static_cast<std::size_t>(last)].vec();
        EXPECT_EQ(editor.replace(last - 1, last, {c.at, end}), 2u);
        EXPECT_EQ(editor.text({}), head + "G1 X1.000 F600\nX1.500\nX3.000\n" + tail) << c.frame;
    }
}

TEST(LineEditor, WritesAngles) {
    const Program program =
        read_text("G90\nG0 X0 Y0 Z0 A0 C0\nG1 X1 F100\nX2.0 A-1.50 C10.5\nX3.0 A-3.00 C20.0\nX4.0 A-4.5 C30.125\n");
    LineEditor editor(program);
    const auto of = [](double a, double c) { return Vec3(a * rad_per_deg, 0, c * rad_per_deg); };
    editor.replace(2, 4, {{1.5, 0, 0}, {2, 0.1, 0}, {3.5, 0, 0}, {4, 0, 0}},
                   {{of(-0.75, 5.25), -1}, {of(-1.5, 10.5), 2}, {of(-3.75, 25.0625), -1}, {of(-4.5, 30.125), 4}});
    const std::string text = editor.text("");
    EXPECT_NE(text.find("F100\nX1.5 A-0.750 C5.250\nX2.0 Y0.1 A-1.50 C10.5\nX3.5 Y0.0 A-3.750 C25.062\nX4.0 A-4.5 "
                        "C30.125\n"),
              std::string::npos)
        << text;
    // Two angles, each off by half a thousandth of a degree.
    EXPECT_NEAR(editor.turn_rounding(), std::hypot(0.0005, 0.0005) * rad_per_deg, 1e-12);
}

TEST(LineEditor, ReplacesAStretchAndNothingElse) {
    const Program program = read_text(part);
    LineEditor editor(program);
    editor.replace(3, 4, {{2.5, 0, 5}, {3.25, 0.125, 5}, {4, 0.5, 5}});
    const std::string text = editor.text("by a test");
    const std::string expected =
        "%\r\nO1000 (PART)\r\n(by a test)\r\n( ROUGH )\r\nG21 G90\r\nG0 X0 Y0 Z5.\r\nN10 G1 X1.000 F600 (ENTRY)\r\nN20 X2.000\r\nN30 X2.500\r\nX3.250 Y0.125\r\nN40 X4.000 Y0.500\r\n"
        "N50 X5.000\r\nM8\r\nN60 X6.000\r\nM2\r\n%";
    EXPECT_EQ(text, expected);
    const Program again = read_text(text);
    EXPECT_EQ(again.motions.end[again.motions.end.size() - 1], program.motions.end[program.motions.end.size() - 1]);
}

TEST(LineEditor, SetsFeedsAndTheProgrammedOneBehindThem) {
    const Program program = read_text(part);
    LineEditor editor(program);
    std::vector<float> feeds(static_cast<std::size_t>(program.motions.size()), 0);
    feeds[3] = 5;  // N30
    feeds[5] = 8;  // N50, before M8
    editor.set_feeds(feeds);
    const std::string text = editor.text("");
    EXPECT_NE(text.find("N20 X2.000\r\nN30 X3.000 F300\r\nN40 X4.000 Y0.500 F600\r\nN50 X5.000 F480\r\nF600\r\nM8\r\n"),
              std::string::npos)
        << text;
    const Program again = read_text(text);
    ASSERT_EQ(again.motions.size(), program.motions.size());
    for (std::size_t i = 1; i < feeds.size(); ++i)
        EXPECT_FLOAT_EQ(again.motions.feed[i], feeds[i] > 0 ? feeds[i] : program.motions.feed[i]) << i;
}

TEST(LineEditor, WritesInchesWhereTheProgramDoes) {
    const Program program = read_text("G20 G90\nG0 X0 Y0 Z0\nG1 X1.0000 F10\nX2.0000\nX3.0000\n");
    LineEditor editor(program);
    EXPECT_DOUBLE_EQ(editor.unit(), 25.4);
    editor.replace(2, 3, {{25.4 * 2.5, 0, 0}, {25.4 * 3, 0, 0}});
    EXPECT_NE(editor.text("").find("X2.5000\nX3.0000\n"), std::string::npos);
}

TEST(LineEditor, WithoutEditsIsTheProgram) {
    const Program program = read_text(part);
    EXPECT_EQ(LineEditor(program).text(""), part);
}

}  // namespace
}  // namespace clsurf::line_edit_test
