#include "mapping/program_lines.h"

#include <gtest/gtest.h>

#include "mapping/line_map.h"
#include "mapping/map_lines.h"
#include "program/interpreter.h"

namespace clsurf::program_lines_test {
namespace {

struct Recorded {
    std::vector<double> x, y, z;
    std::vector<std::uint32_t> line, program;
};

Log log_of(const Recorded& r, std::vector<std::string> programs) {
    Log log;
    log.name = "run";
    log.period = 0.001;
    log.records = static_cast<PointIndex>(r.x.size());
    const auto add = [&](const char* name, const void* data, ScalarType type, std::size_t stride) {
        log.channels.push_back(
            {name, "", {static_cast<const std::byte*>(data), stride, log.records, type, false, 1.0, 0.0}});
    };
    add("cmd.x", r.x.data(), ScalarType::f64, 8);
    add("cmd.y", r.y.data(), ScalarType::f64, 8);
    add("cmd.z", r.z.data(), ScalarType::f64, 8);
    add("line", r.line.data(), ScalarType::u32, 4);
    if (!r.program.empty()) add("program", r.program.data(), ScalarType::u32, 4);
    for (std::string& name : programs) log.programs.push_back({std::move(name), {}, {}});
    return log;
}

Program parse(const std::string& name, std::string_view text) {
    return parse_program(SourceText(name, text, nullptr), {});
}

TEST(ProgramLines, ALineOfASubprogramIsTheLineThatCalledIt) {
    const Recorded r{{0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}, {9, 2, 7, 8, 3}, {2, 0, 1, 1, 0}};
    const Log log = log_of(r, {"/_N_WKS_DIR/_N_PART_MPF", "/_SUB", "(not recorded)"});
    Diagnostics diagnostics;
    const ProgramLines own = lines_of_program(log, parse("nc/part.mpf", "G1 X1 F100\nG1 X2\nG1 X3\n"), diagnostics);
    ASSERT_TRUE(own.lines);
    const LineNumber expected[] = {0, 2, 2, 2, 3};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ((*own.lines)[i], expected[i]) << i;
    EXPECT_TRUE(diagnostics.empty());
}

TEST(ProgramLines, ALineThatCallsCutsWhileItsSubprogramDoes) {
    InterpreterOptions options;
    options.load = [](const std::string&) {
        return std::optional(SourceText("sub.spf", "G1 X2\nG1 X3\nRET\n", nullptr));
    };
    options.dialect = find_dialect("siemens");
    const Program program = parse_program(SourceText("part.mpf", "G1 X1 F100\nM8\nSUB\nG1 X4\nM9\n", nullptr), options);
    ASSERT_EQ(program.motions.size(), 4);
    const Recorded r{
        {0.5, 1, 1.5, 2.5, 3.5, 4}, {0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}, {1, 1, 1, 2, 4, 5}, {0, 0, 1, 1, 0, 0}};
    const Log log = log_of(r, {"/_N_PART_MPF", "/_N_SUB_SPF"});
    Diagnostics diagnostics;
    const LineMap map = map_lines(reconstruct(log, Role::commanded, Vec3::Zero()), log, program, true, diagnostics);
    EXPECT_EQ(map.kind_of(3), PointKind::cut);   // the call
    EXPECT_EQ(map.kind_of(5), PointKind::idle);  // after the last motion
}

TEST(ProgramLines, SaysWhichProgramsRanWhereNoneIsThisOne) {
    const Recorded r{{0, 0}, {0, 0}, {0, 0}, {9, 2}, {0, 1}};
    Diagnostics diagnostics;
    const ProgramLines own =
        lines_of_program(log_of(r, {"/_A", "/_B"}), parse("part.mpf", "G1 X1 F100\n"), diagnostics);
    EXPECT_FALSE(own.known);
    ASSERT_EQ(diagnostics.count("map.program"), 1u);
    EXPECT_NE(diagnostics.kept()[0].text.find("/_A, /_B"), std::string::npos);
}

TEST(ProgramLines, AreThoseOfTheLogWhereItNamesOneProgram) {
    const Recorded r{{0, 0}, {0, 0}, {0, 0}, {9, 2}, {}};
    Diagnostics diagnostics;
    const ProgramLines own = lines_of_program(log_of(r, {"other.nc"}), parse("part.nc", "G1 X1 F100\n"), diagnostics);
    EXPECT_FALSE(own.lines);
    EXPECT_TRUE(own.known);
}

/// A program of 100 lines of 1 mm each, run at 1 mm per record from line `first` to line `last`.
void run(Recorded& r, int first, int last) {
    for (int line = first; line <= last; ++line) {
        for (int k = 0; k < 4; ++k) {
            r.x.push_back(line - 1 + (k + 1) * 0.25);
            r.line.push_back(static_cast<std::uint32_t>(line));
        }
    }
    r.y.assign(r.x.size(), 0);
    r.z.assign(r.x.size(), 0);
}

/// Its first `lines` lines.
std::string text_of(int lines) {
    std::string text;
    for (int line = 1; line <= lines; ++line) text += "G1 X" + std::to_string(line) + " F100\n";
    return text;
}

ProgramMatch match_of(const Recorded& r, const Program& program, Diagnostics& diagnostics,
                      ProgramIdentity identity = ProgramIdentity::unknown) {
    const Log log = log_of(r, {});
    return map_lines(reconstruct(log, Role::commanded, Vec3::Zero()), log, program, true, diagnostics, identity)
        .match();
}

Diagnostics course_of(const Recorded& r, ProgramIdentity identity = ProgramIdentity::unknown) {
    Diagnostics diagnostics;
    (void)match_of(r, parse("part.nc", text_of(100)), diagnostics, identity);
    return diagnostics;
}

TEST(UnknownLines, TellALogOfAnotherProgram) {
    Recorded r;
    run(r, 1, 100);
    Diagnostics diagnostics;
    const ProgramMatch match = match_of(r, parse("part.nc", text_of(30)), diagnostics);
    EXPECT_EQ(match.foreign,
              "280 of 399 moving points have line numbers that the program of 30 lines does not have: 31 … 100");
}

TEST(UnknownLines, OfAnEndThatIsMissingAreAWarning) {
    Recorded r;
    run(r, 1, 100);
    Diagnostics diagnostics;
    EXPECT_EQ(match_of(r, parse("part.nc", text_of(80)), diagnostics).foreign, "");
    ASSERT_EQ(diagnostics.count("map.line-range"), 1u);
    EXPECT_EQ(diagnostics.kept()[0].where.number, 320u);
    EXPECT_NE(diagnostics.kept()[0].text.find("80 of 399 moving points"), std::string::npos)
        << diagnostics.kept()[0].text;
}

TEST(UnknownLines, OfAnotherProgramByItsHashNeedFewerPoints) {
    Recorded r;
    run(r, 1, 100);
    Diagnostics diagnostics;
    EXPECT_NE(match_of(r, parse("part.nc", text_of(80)), diagnostics, ProgramIdentity::other).foreign, "");
}

TEST(UnknownLines, AtRestBehindTheProgramAreNoFinding) {
    Recorded r;
    run(r, 1, 100);
    for (int i = 0; i < 900; ++i) {  // the tool rests, on a line of the program that is loaded next
        r.x.push_back(100);
        r.line.push_back(500);
    }
    r.y.assign(r.x.size(), 0);
    r.z.assign(r.x.size(), 0);
    const Diagnostics found = course_of(r);
    EXPECT_EQ(found.count("map.line-range"), 0u);
    EXPECT_EQ(found.count("map.foreign"), 0u);
}

TEST(UnknownLines, OneLineMoreAtTheEndIsNoFinding) {
    Recorded r;
    run(r, 1, 100);
    r.line.back() = 101;
    EXPECT_TRUE(course_of(r).empty());
}

TEST(UnknownLines, OfABlockNumberAreNoneWhereThePathFits) {
    Recorded r;
    run(r, 1, 100);
    for (std::uint32_t& line : r.line) line *= 10;
    Diagnostics diagnostics;
    EXPECT_EQ(match_of(r, parse("part.nc", text_of(100)), diagnostics).foreign, "");
    EXPECT_EQ(diagnostics.count("map.line-numbers"), 1u);
}

TEST(UnknownLines, OfASubprogramsFileBelongToTheProgram) {
    const std::string text = text_of(100) + "RET\n";
    InterpreterOptions options;
    options.load = [&](const std::string&) { return std::optional(SourceText("sub.spf", text, nullptr)); };
    options.dialect = find_dialect("siemens");
    const Program program = parse_program(SourceText("part.mpf", "G90\nSUB\nM30\n", nullptr), options);
    Recorded r;
    run(r, 1, 100);
    Diagnostics diagnostics;
    EXPECT_EQ(match_of(r, program, diagnostics).foreign, "");
    EXPECT_EQ(diagnostics.count("map.line-range"), 0u);
}

TEST(ProgramCourse, SaysNothingOfAWholeRun) {
    Recorded r;
    run(r, 1, 100);
    EXPECT_TRUE(course_of(r).empty());
}

TEST(ProgramCourse, DoesNotMissMotionsWithoutALength) {
    Recorded r;
    run(r, 1, 4);
    for (std::uint32_t& line : r.line) line += 1;
    r.x.insert(r.x.begin(), 0);
    r.line.insert(r.line.begin(), 2);
    r.y.assign(r.x.size(), 0);
    r.z.assign(r.x.size(), 0);
    Diagnostics diagnostics;
    (void)match_of(r, parse("part.nc", "G0 X0 Y0 Z0\n" + text_of(4) + "X4\nX4\n"), diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << diagnostics.kept()[0].text;
}

TEST(ProgramCourse, FindsTwoRunsInOneLog) {
    Recorded r;
    run(r, 1, 100);
    run(r, 1, 100);
    const Diagnostics found = course_of(r);
    ASSERT_EQ(found.count("map.runs"), 1u);
    EXPECT_EQ(found.kept()[0].where.number, 400u);
}

TEST(ProgramCourse, FindsARunThatWentOnFromAnEarlierLine) {
    Recorded r;
    run(r, 1, 60);
    for (int k = 0; k < 8; ++k) {  // the tool is lifted and moves back, with the number of the stopped line
        r.x.push_back(60 - (k + 1) * 31 / 8.0);
        r.line.push_back(60);
    }
    run(r, 30, 100);
    for (std::size_t i = 240; i < 248; ++i) r.z[i] = 5;
    const Diagnostics found = course_of(r, ProgramIdentity::same);
    ASSERT_EQ(found.count("map.restart"), 1u);
    EXPECT_EQ(found.kept().size(), 1u) << found.kept()[0].text;
    EXPECT_EQ(found.kept()[0].where.number, 248u);
    EXPECT_EQ(found.kept()[0].text,
              "the tool leaves the path on line 60 at point 240, and the run goes on from line 30: lines 30-60 ran "
              "twice");
}

TEST(ProgramCourse, WhatWasSkippedBeforeDidNotRunTwice) {
    Recorded r;
    run(r, 1, 20);
    run(r, 60, 100);
    run(r, 21, 59);
    EXPECT_EQ(course_of(r).count("map.restart"), 0u);
}

TEST(ProgramCourse, ANumberThatFlickersIsNoRun) {
    Recorded r;
    run(r, 1, 100);
    for (const std::size_t i : {201, 203, 205}) r.line[i] = 48;
    EXPECT_EQ(course_of(r).count("map.restart"), 0u);
}

TEST(ProgramCourse, FindsALogThatBeginsInTheMiddle) {
    Recorded r;
    run(r, 50, 80);
    const Diagnostics found = course_of(r);
    ASSERT_EQ(found.count("map.begins-inside"), 1u);
    EXPECT_NE(found.kept()[0].text.find("begins at line 50: 49 %"), std::string::npos) << found.kept()[0].text;
    EXPECT_EQ(found.count("map.ends-early"), 1u);
}

TEST(ProgramCourse, FindsAPause) {
    Recorded r;
    run(r, 1, 50);
    for (int i = 0; i < 2500; ++i) {
        r.x.push_back(50);
        r.line.push_back(50);
    }
    run(r, 51, 100);
    const Diagnostics found = course_of(r);
    ASSERT_EQ(found.count("map.pause"), 1u);
    EXPECT_NE(found.kept()[0].text.find("stands still for 2.5 s on line 50"), std::string::npos)
        << found.kept()[0].text;
}

}  // namespace
}  // namespace clsurf::program_lines_test
