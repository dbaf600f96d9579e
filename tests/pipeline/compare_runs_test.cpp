// A reference run and the runs that are compared with it: simulated, recorded, and those of parts.

#include "pipeline/compare_runs.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "pipeline/programmed_part.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"

namespace clsurf::compare_runs_test {
namespace {

constexpr int passes = 8, slow_pass = 5;
constexpr LineNumber slow_line = 4 + 2 * slow_pass + 1;

/// A zigzag at 50 mm/s, 0.4 mm between passes of 20 mm. Each pass is two lines, from line 4 on: to its side, and along it.
/// `slow`: the feed [mm/min] of one of them.
std::string zigzag(int slow = 3000, double from = 0) {
    std::string text = fmt::format("G21 G90\nG0 X{} Y0 Z0\nG1 F3000\n", from);
    for (int pass = 0; pass < passes; ++pass)
        text += fmt::format("Y{:.1f} F3000\nX{} F{}\n", 0.4 * pass, from + (pass % 2 == 0 ? 20 : 0),
                            pass == slow_pass ? slow : 3000);
    return text;
}

PlacedRun simulated(const std::string& name, const std::string& text, const Vec3& start = Vec3::Zero()) {
    return simulate_run(name, read_text(text), Machine{}, start, {});
}

Log log_of(const std::string& text) { return simulate_to_log(read_text(text), Machine{}).log; }

/// The log without its channels of one role, "cmd" or "fb", or without its lines.
Log without(Log log, const std::string& prefix) {
    std::erase_if(log.channels, [&](const Channel& channel) { return channel.name.starts_with(prefix); });
    return log;
}

/// The sections whose speed differs.
std::vector<RunDifferenceSection> speeds_of(const RunReport& report) {
    std::vector<RunDifferenceSection> found;
    std::ranges::copy_if(report.sections, std::back_inserter(found),
                         [](const RunDifferenceSection& s) { return s.quantity == RunQuantity::speed; });
    return found;
}

void expect_the_slow_pass(const RunReport& report, LineNumber line) {
    EXPECT_NEAR(report.aligned, report.arc_length, 0.1);
    const std::vector<RunDifferenceSection> found = speeds_of(report);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].relative_peak, -0.2, 0.005) << "40 instead of 50 mm/s";
    EXPECT_NEAR(found[0].length, 20, 2);
    EXPECT_EQ(found[0].first_line, line);
    EXPECT_EQ(found[0].last_line, line);
}

TEST(CompareRuns, FindsTheSlowPassOfASimulatedRun) {
    ReferenceRun reference(simulated("a", zigzag()));
    Diagnostics diagnostics;
    const ComparedWithReference found = reference.compare(simulated("b", zigzag(2400)), diagnostics);
    expect_the_slow_pass(found.report, slow_line);
    EXPECT_FALSE(found.roughness) << "no tool";
    EXPECT_NEAR(reference.surface().step_over, 0.4, 0.01);
    EXPECT_EQ(reference.path().count, reference.run().log.records);
}

TEST(CompareRuns, FindsTheSamePassOfPartsAndOfLogs) {
    Diagnostics diagnostics;
    const Part a = simulated_part(read_text(zigzag()), {}).part, b = simulated_part(read_text(zigzag(2400)), {}).part;
    ReferenceRun of_part(placed_run(a));
    expect_the_slow_pass(of_part.compare(placed_run(b), diagnostics).report, slow_line);
    int read = 0;
    ComparisonRules rules;
    rules.placing.program_of = [&](const Log&) {
        ++read;
        return ProgramOfLog{read_text(zigzag())};
    };
    ReferenceRun of_log(placed_run("a", without(log_of(zigzag()), "line"), {}), rules);
    for (int k = 0; k < 2; ++k) {
        const PlacedRun run = placed_run("b", without(log_of(zigzag(2400)), "line"), {});
        expect_the_slow_pass(of_log.compare(run, diagnostics).report, slow_line);
    }
    EXPECT_EQ(read, 1) << "lines are those of the reference";
}

TEST(CompareRuns, WithoutAProgramLinesAreThoseOfTheChannelOrUnknown) {
    Diagnostics diagnostics;
    const PlacedRun slow = placed_run("b", log_of(zigzag(2400)), {});
    ReferenceRun with_lines(placed_run("a", log_of(zigzag()), {}));
    expect_the_slow_pass(with_lines.compare(slow, diagnostics).report, slow_line);
    ReferenceRun without_lines(placed_run("a", without(log_of(zigzag()), "line"), {}));
    expect_the_slow_pass(without_lines.compare(slow, diagnostics).report, 0);
    ReferenceRun of_part(placed_run(assemble(without(log_of(zigzag()), "line"))));
    expect_the_slow_pass(of_part.compare(slow, diagnostics).report, 0);
}

TEST(CompareRuns, TheToolIsAskedOnceAndGivesContactsAndRoughness) {
    int asked = 0;
    ComparisonRules rules;
    rules.with_roughness = true;
    rules.tool_of = [&](const Log&, const Program* program, Diagnostics&) {
        EXPECT_NE(program, nullptr);
        ++asked;
        return parse_tool("ball:6");
    };
    ReferenceRun reference(simulated("a", zigzag()), rules);
    Diagnostics diagnostics;
    for (int k = 0; k < 2; ++k) {
        const ComparedWithReference found = reference.compare(simulated("b", zigzag(2400)), diagnostics);
        ASSERT_EQ(speeds_of(found.report).size(), 1U);
        const CutterPlace place = speeds_of(found.report).front().place;
        ASSERT_TRUE(place.contact);
        EXPECT_LT((*place.contact - place.tip).norm(), 1e-3) << "a level surface is touched by the tip";
        EXPECT_TRUE(found.roughness);
    }
    EXPECT_EQ(asked, 1);
    PartRules of_part;
    of_part.tool = parse_tool("ball:6");
    const Part part = simulated_part(read_text(zigzag()), of_part).part;
    ReferenceRun with_its_tool(placed_run(part));
    const ComparedWithReference found = with_its_tool.compare(simulated("b", zigzag(2400)), diagnostics);
    EXPECT_TRUE(found.report.sections.front().place.contact);
    EXPECT_FALSE(found.roughness) << "not requested";
}

TEST(CompareRuns, TheOneOfThreeThatDriftedIsKnown) {
    ReferenceRun reference(simulated("a", zigzag()));
    EXPECT_TRUE(reference.departures().empty());
    Diagnostics diagnostics;
    (void)reference.compare(simulated("b", zigzag(2400)), diagnostics);
    EXPECT_TRUE(reference.departures().empty()) << "two runs do not say which one drifted";
    (void)reference.compare(simulated("c", zigzag()), diagnostics);
    ASSERT_EQ(reference.departures().size(), 3U);
    EXPECT_EQ(drifted_run(reference.departures()), 1U);
}

/// The diagnostic of the InputError that `compare` throws.
template <typename Compare>
Diagnostic refused(Compare&& compare) {
    try {
        compare();
    } catch (const InputError& error) { return error.diagnostic(); }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

TEST(CompareRuns, ARunElsewhereIsRefusedWithTheHintOfTheCaller) {
    ComparisonRules rules;
    rules.other_path_hint = "look elsewhere";
    ReferenceRun reference(simulated("a", zigzag()), rules);
    const PlacedRun elsewhere = simulated("b", zigzag(3000, 500), Vec3(500, 0, 0));
    Diagnostics diagnostics;
    const Diagnostic why = refused([&] { (void)reference.compare(elsewhere, diagnostics); });
    EXPECT_EQ(why.where.file, "b");
    EXPECT_EQ(why.text, "shares no path with a");
    EXPECT_EQ(why.hint, "look elsewhere");
    EXPECT_NEAR(reference.compare(simulated("c", zigzag()), diagnostics).report.aligned, 20 * passes, 5)
        << "others can still be compared";
}

TEST(CompareRuns, AllRunsAreComparedByTheSamePositions) {
    ComparisonRules rules;
    rules.other_roles_hint = "choose";
    ReferenceRun reference(placed_run("a", log_of(zigzag()), {}), rules);
    Diagnostics diagnostics;
    (void)reference.compare(placed_run("b", log_of(zigzag()), {}), diagnostics);
    const Diagnostic why =
        refused([&] { (void)reference.compare(placed_run("c", without(log_of(zigzag()), "cmd"), {}), diagnostics); });
    EXPECT_EQ(why.where.file, "c");
    EXPECT_EQ(why.hint, "choose");
    rules.role = Role::feedback;
    ReferenceRun by_feedback(placed_run("a", log_of(zigzag()), {}), rules);
    EXPECT_NO_THROW((void)by_feedback.compare(placed_run("b", log_of(zigzag()), {}), diagnostics));
    EXPECT_EQ(by_feedback.path().role, Role::feedback);
}

TEST(CompareRuns, ALogOfAnotherProgramIsRefusedUnlessItIsAccepted) {
    ComparisonRules rules;
    rules.placing.program_of = [](const Log&) {
        return ProgramOfLog{read_text("G21 G90\nG0 X0 Y0 Z0\nG1 X90 Y90 F1000\nX-90\nX80 Y-70\n")};
    };
    const auto compare = [&](Diagnostics& diagnostics) {
        ReferenceRun reference(placed_run("a", without(log_of(zigzag()), "line"), {}), rules);
        (void)reference.compare(placed_run("b", log_of(zigzag()), {}), diagnostics);
    };
    Diagnostics diagnostics;
    EXPECT_THROW(compare(diagnostics), InputError);
    rules.placing.accept_foreign = true;
    Diagnostics accepted;
    EXPECT_NO_THROW(compare(accepted));
    EXPECT_EQ(accepted.count("map.foreign"), 1);
}

TEST(CompareRuns, AnEmptyLogIsNoRun) {
    Log log;
    log.name = "empty.csv";
    EXPECT_EQ(refused([&] { (void)placed_run("empty", std::move(log), {}); }).text, "contains no records");
}

}  // namespace
}  // namespace clsurf::compare_runs_test
