// Parts of programs without logs: values of the program, positions of its points, and the motion of a machine.

#include "pipeline/programmed_part.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "field/field_set.h"
#include "pipeline/part_fields.h"
#include "pipeline/program_fields.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"

namespace clsurf::programmed_part_test {
namespace {

constexpr double deg = std::numbers::pi / 180;

Program program_of(const std::string& text) {
    auto bytes = std::make_shared<std::string>(text);
    return parse_program(SourceText("part.nc", *bytes, bytes), {});
}

/// The value of a field at the end of the motion of a line.
float value_at_line(const std::string& text, const std::string& name, LineNumber line) {
    const ProgrammedPart made = programmed_part(program_of(text));
    FieldSet fields(made.part.log.records);
    fields.add(std::make_shared<const ProgramFields>(made.part.program, made.part.lines));
    const Field field = fields.get(name);
    for (const PointRange& range : made.part.lines->points_of(line))
        return field.values[static_cast<std::size_t>(range.last)];
    ADD_FAILURE() << "no point of line " << line;
    return 0;
}

TEST(ProgramFields, FeedAndLengthOfBlocks) {
    const std::string text = "G0 X0 Y0 Z0\nG1 X3 Y4 F1200\nG3 X1 Y4 I-1 J0\nG1 X1 Y0 F600\n";
    EXPECT_FLOAT_EQ(value_at_line(text, "programmed_feed", 2), 20);
    EXPECT_FLOAT_EQ(value_at_line(text, "block_length", 2), 5);
    EXPECT_FLOAT_EQ(value_at_line(text, "block_length", 3), static_cast<float>(std::numbers::pi));
    EXPECT_TRUE(std::isnan(value_at_line(text, "block_length", 1))) << "a rapid has no value";
}

TEST(ProgramFields, AnglesBetweenBlocksAreThoseOfTheirDirections) {
    // A line along X, a tangential arc that turns by 90°, and a line that leaves the arc at an angle of 10°.
    const std::string text = "G0 X0 Y0 Z0\nG1 X5 F1200\nG3 X6 Y1 I0 J1\nG1 X" +
                             std::to_string(6 - 2 * std::sin(10 * deg)) + " Y" +
                             std::to_string(1 + 2 * std::cos(10 * deg)) + "\n";
    EXPECT_NEAR(value_at_line(text, "turning_angle", 2), 0, 1e-6);
    EXPECT_NEAR(value_at_line(text, "turning_angle", 3), 10 * deg, 1e-6);
    EXPECT_NEAR(value_at_line(text, "turning_angle", 4), 10 * deg, 1e-6);
}

/// Chords of a circle, with coordinates of a given number of digits, followed by one corner of 90°.
std::string chords(double radius, double step, int digits) {
    std::string text = "G0 X" + std::to_string(radius) + " Y0 Z0\nG1 F1200\n";
    char line[80];
    for (double a = step / radius; a < 1; a += step / radius) {
        std::snprintf(line, sizeof line, "X%.*f Y%.*f\n", digits, radius * std::cos(a), digits, radius * std::sin(a));
        text += line;
    }
    return text;
}

TEST(ProgramFields, CurvatureOfChordsIsThatOfTheCircle) {
    EXPECT_NEAR(value_at_line(chords(20, 0.5, 7), "programmed_curvature", 20), 1.0 / 20, 1e-5);
    // Three neighbours rounded to micrometres and 0.05 mm apart would have 0.3/mm on average, six times too much.
    EXPECT_NEAR(value_at_line(chords(20, 0.05, 3), "programmed_curvature", 200), 1.0 / 20, 0.01);
    EXPECT_FLOAT_EQ(value_at_line("G0 X0 Y0 Z0\nG1 X5 F1200\nG3 X9 Y4 I0 J4\n", "programmed_curvature", 3), 0.25F);
}

TEST(ProgramFields, ACornerIsNoCurvature) {
    const std::string text = "G0 X0 Y0 Z0\nG1 X5 F1200\nX10\nY5\nY10\n";
    for (const LineNumber line : {2U, 3U, 4U, 5U})
        EXPECT_FLOAT_EQ(value_at_line(text, "programmed_curvature", line), 0);
    EXPECT_FLOAT_EQ(value_at_line(text, "turning_angle", 3), static_cast<float>(90 * deg));
}

TEST(ProgramFields, PointsOfALogHaveThoseOfTheirLines) {
    const std::string text = wavy_zigzag(
        5, 12, [](int pass, double) { return pass == 2 ? 0.1 : 0.3; }, 0);
    const Part part = simulated_part(program_of(text), {}).part;
    const ClSurface surface = stitch(part);
    const Field length = fields_of(part, surface).get("block_length");
    for (PointIndex i = 0; i < part.log.records; i += 97) {
        const std::int64_t motion = part.lines->motion_at(i);
        if (motion <= 0 || part.program.motions.kind[static_cast<std::size_t>(motion)] != MotionKind::feed) continue;
        const double expected = (part.program.motions.end[static_cast<std::size_t>(motion)].vec() -
                                 part.program.motions.end[static_cast<std::size_t>(motion - 1)].vec())
                                    .norm();
        EXPECT_NEAR(length.values[static_cast<std::size_t>(i)], expected, 1e-6);
    }
}

TEST(SimulatedPart, IsThePartOfTheSimulatedLog) {
    const std::string text = wavy_zigzag(
        5, 12, [](int, double) { return 0.3; }, 0);
    const Part made = simulated_part(program_of(text), {}).part;
    const Part read = assemble(program_of(text), simulate_to_log(read_text(text), Machine{}).log);
    ASSERT_EQ(made.log.records, read.log.records);
    for (PointIndex i = 0; i < made.log.records; i += 101) {
        EXPECT_EQ(made.path.at(i), read.path.at(i));
        EXPECT_EQ(made.lines->line_at(i), read.lines->line_at(i));
    }
    EXPECT_NE(made.log.find("limit"), nullptr);
}

TEST(SimulatedPart, APlungeBehindARoundedCornerIsNoPass) {
    // The controller rounds the corner from the rapid to the plunge: the plunge begins some micrometres aside.
    std::string text = "G0 X520 Y-310 Z31.5\nG1 Z1.5 F4000\n";
    for (int pass = 0; pass < 8; ++pass) {
        text += "Y" + std::to_string(-310 + 0.4 * pass) + "\n";
        text += pass % 2 == 0 ? "X560\n" : "X520\n";
    }
    const Part part = simulated_part(program_of(text), {}).part;
    const ClSurface surface = stitch(part);
    int cuts = 0;
    for (const Pass& pass : surface.passes) {
        if (!is_of_surface(pass.kind)) continue;
        cuts += pass.kind == PassKind::cut ? 1 : 0;
        for (PointIndex i = pass.first; i <= pass.last; ++i)
            ASSERT_LT(surface.positions.absolute(i).z(), 2) << "point " << i;
    }
    EXPECT_EQ(cuts, 8);
}

}  // namespace
}  // namespace clsurf::programmed_part_test
