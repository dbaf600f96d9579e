// The calls of docs/api.md: from a program and a machine to a log, from both to a part, to its defects.

#include "pipeline/part.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "io/readers/part_file.h"
#include "pipeline/judge.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"

namespace clsurf::part_test {
namespace {

/// Nine passes, the fourth with points 0.02 mm apart over 2 mm, where blocks of 2 ms are slower than the feed.
std::string crowded_program() {
    return wavy_zigzag(
        9, 24, [](int pass, double x) { return pass == 3 && x > 6 && x < 8 ? 0.02 : 0.31; }, 0);
}

Machine slow_at_short_blocks() {
    Machine machine;
    machine.controller.block_time = 0.002;
    return machine;
}

/// As programmed, each motion in its own work coordinate system.
Program program_of(const std::string& text) {
    auto bytes = std::make_shared<std::string>(text);
    return parse_program(SourceText("part.nc", *bytes, bytes), {});
}

Log run_of(const std::string& text) { return simulate_to_log(read_text(text), slow_at_short_blocks()).log; }

TEST(Pipeline, FindsTheLinesOfASimulatedRunThatLeaveAMark) {
    const std::string text = crowded_program();
    const Part part = assemble(program_of(text), run_of(text));
    const ClSurface surface = stitch(part);
    EXPECT_NEAR(surface.step_over, 0.4, 0.01);
    const Quality quality = judge(part, surface);
    ASSERT_FALSE(quality.report.defects.empty());
    const DefectSection& section = quality.report.defects.front().sections.front();
    EXPECT_EQ(section.pass, 4);
    // The reported line is one of those 0.02 mm apart.
    const std::int64_t motion = part.lines->motion_at(section.points.first + section.points.size() / 2);
    ASSERT_GT(motion, 0);
    const Vec3 step = part.program.motions.end[static_cast<std::size_t>(motion)].vec() -
                      part.program.motions.end[static_cast<std::size_t>(motion - 1)].vec();
    EXPECT_NEAR(std::abs(step.x()), 0.02, 0.001);
    EXPECT_FALSE(quality.as_machined) << "no tool";
}

TEST(Pipeline, FindsTheSameStepByStep) {
    const std::string text = crowded_program();
    const Part part = assemble(program_of(text), run_of(text));
    const ClSurface surface = stitch(part);
    const QualityReport report = find_defects(part, surface, signals_of(part, surface));
    const Quality quality = judge(part, surface);
    ASSERT_EQ(report.defects.size(), quality.report.defects.size());
    for (std::size_t i = 0; i < report.defects.size(); ++i)
        EXPECT_EQ(report.defects[i].point, quality.report.defects[i].point);
}

// Values own their data: a part outlives the program, the log and the part from which it was copied.
TEST(Pipeline, PartsOwnWhatTheyHold) {
    std::optional<Part> copy;
    std::size_t defects = 0;
    {
        const std::string text = crowded_program();
        auto original = std::make_unique<Part>(assemble(program_of(text), run_of(text)));
        defects = judge(*original, stitch(*original)).report.defects.size();
        copy = *original;
    }
    EXPECT_EQ(judge(*copy, stitch(*copy)).report.defects.size(), defects);
    EXPECT_GT(defects, 0U);
}

TEST(Pipeline, JudgesOnePartInSeveralThreads) {
    const std::string text = crowded_program();
    const Part part = assemble(program_of(text), run_of(text));
    const ClSurface surface = stitch(part);
    const QualityReport alone = judge(part, surface).report;
    std::vector<QualityReport> reports(4);
    {
        std::vector<std::jthread> threads;
        for (QualityReport& report : reports)
            threads.emplace_back([&report, &part, &surface] { report = judge(part, surface).report; });
    }
    for (const QualityReport& report : reports) {
        ASSERT_EQ(report.defects.size(), alone.defects.size());
        for (std::size_t i = 0; i < alone.defects.size(); ++i) {
            EXPECT_EQ(report.defects[i].point, alone.defects[i].point);
            EXPECT_EQ(report.defects[i].depth, alone.defects[i].depth);
        }
    }
}

TEST(Pipeline, RefusesLogsThatAreEmptyOrOfAnotherProgram) {
    const std::string text = crowded_program();
    Log empty;
    empty.name = "empty";
    EXPECT_THROW((void)assemble(program_of(text), empty), InputError);
    EXPECT_THROW((void)assemble(empty), InputError);
    const std::string another = "G21 G90\nG0 X0 Y0 Z30\nG1 X90 F3000\nY90\nX0\nY0\nM30\n";
    EXPECT_THROW((void)assemble(program_of(another), run_of(text)), InputError);
    PartRules rules;
    rules.accept_foreign = true;
    const Part part = assemble(program_of(another), run_of(text), rules);
    EXPECT_EQ(part.diagnostics.count("map.foreign"), 1U);
    EXPECT_FALSE(judge(part, stitch(part)).report.judgement.judged());
}

TEST(Pipeline, TakesALogAlone) {
    const Part part = assemble(run_of(crowded_program()));
    EXPECT_EQ(part.path.role, Role::commanded);
    EXPECT_GT(part.lines->line_at(part.path.count / 2), 0U);
    ASSERT_EQ(other_roles(part).size(), 1U);
    EXPECT_EQ(other_roles(part).front().role, Role::feedback);
}

TEST(Pipeline, ReadsWhatFilesSayOfEachOther) {
    const std::string data = SAMPLE_DATA;
    const Part part = io::read_part(data + "/programs/bottle_uneven.nc", SAMPLE_LOGS "/bottle_uneven.biip");
    ASSERT_TRUE(part.tool) << "the log's metadata name it";
    EXPECT_EQ(to_text(*part.tool), "ball:6");
    EXPECT_EQ(part.diagnostics.count("log.program"), 0U);
    EXPECT_THROW((void)io::read_part(data + "/programs/dome_loops.nc", SAMPLE_LOGS "/bottle_uneven.biip"), InputError);
}

}  // namespace
}  // namespace clsurf::part_test
