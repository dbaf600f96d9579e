// Alignment without a line channel, compared with the kernel's own line numbers: a point's line is right
// if it is between the kernel's previous reported line and the reported one, plus one line
// (a kernel reports the last of the lines that it merged, and changes the number where a blend begins).
#include "mapping/line_map.h"

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "mapping/alignment.h"
#include "mapping/allowed_motions.h"
#include "mapping/map_lines.h"
#include "program/feed_mode_cursor.h"
#include "program/interpreter.h"
#include "program/tool_centre_point.h"

namespace clsurf::line_map_test {
namespace {

struct Sample {
    const char *program, *log;
    const char* layout = "";
    double period = 0;
};

double right_share(const Sample& sample) {
    const Program program = io::read_program(std::string(SAMPLE_DATA "/programs/") + sample.program);
    io::LogOptions options;
    if (*sample.layout != 0) options.layout = std::string(SAMPLE_DATA "/logs/") + sample.layout;
    if (sample.period > 0) options.period = sample.period;
    const Log log = io::open_log(std::string(SAMPLE_LOGS "/") + sample.log, options);
    const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
    Diagnostics diagnostics;
    const LineMap reported = map_lines(path, log, program, true, diagnostics);
    EXPECT_EQ(diagnostics.count("map.disagreement"), 0u) << sample.log;
    const LineMap ours = map_lines(path, log, program, false, diagnostics);
    std::int64_t moving = 0;
    std::int64_t right = 0;
    LineNumber line = 0;
    LineNumber before = 0;
    Vec3 last = path.at(0);
    for (PointIndex i = 0; i < path.count; ++i) {
        const LineNumber now = reported.line_at(i);
        if (now != line) {
            before = line;
            line = now;
        }
        const Vec3 p = path.at(i);
        const bool moves = (p - last).norm() > 0;
        last = p;
        if (!moves || now == 0) continue;
        ++moving;
        const LineNumber low = before == 0 ? line : std::min(before, line);
        const LineNumber high = std::max(before, line);
        const LineNumber mine = ours.line_at(i);
        if (mine + 1 >= low && mine <= high + 1) ++right;
    }
    return static_cast<double>(right) / static_cast<double>(moving);
}

class Alignment : public testing::TestWithParam<Sample> {};

TEST_P(Alignment, FindsTheLinesOfARecordedLog) { EXPECT_GE(right_share(GetParam()), 0.995); }

INSTANTIATE_TEST_SUITE_P(Recorded, Alignment,
                         testing::Values(Sample{"bottle_uneven.nc", "bottle_uneven.biip"},
                                         Sample{"bottle_zigzag.nc", "bottle_zigzag.biip"},
                                         Sample{"dome_loops.nc", "dome_loops.biip"},
                                         Sample{"transition_g61.nc", "transition_g61.biip"},
                                         Sample{"petal_zigzag_g64.ngc", "petal_zigzag_g64.biip"},
                                         Sample{"petal_zigzag_irregular.ngc", "petal_zigzag_irregular.biip"},
                                         Sample{"petal_loops_g64.ngc", "petal_loops_g64.biip"},
                                         Sample{"petal_spiral.ngc", "petal_spiral.raw", "petal_spiral.layout.toml"},
                                         Sample{"mixed.ngc", "mixed.csv", "", 0.001}));

TEST(LineMap, WarnsOfALogThatBelongsToAnotherProgram) {
    const Program program = io::read_program(SAMPLE_DATA "/programs/petal_loops_g64.ngc");
    const Log log = io::open_log(SAMPLE_LOGS "/bottle_uneven.biip", {});
    const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
    Diagnostics diagnostics;
    (void)map_lines(path, log, program, true, diagnostics);
    EXPECT_EQ(diagnostics.count("map.disagreement"), 1u);
    (void)map_lines(path, log, program, false, diagnostics);
    EXPECT_GE(diagnostics.count("map.lost"), 1u);
}

TEST(LineMap, FindsItsPlaceInALogThatBeginsInTheMiddle) {
    const Program program = io::read_program(SAMPLE_DATA "/programs/bottle_uneven.nc");
    const Log log = io::open_log(SAMPLE_LOGS "/bottle_uneven.biip", {});
    Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
    constexpr PointIndex cut = 12'000;
    for (ChannelView& axis : path.axes) {
        axis.first += static_cast<std::size_t>(cut) * axis.stride;
        axis.count -= cut;
    }
    path.count -= cut;
    Diagnostics diagnostics;
    const LineMap ours = align_lines(path, program, diagnostics);
    const LineMap whole = map_lines(reconstruct(log, Role::commanded, Vec3::Zero()), log, program, true, diagnostics);
    for (const PointIndex i : {0, 500, 5000}) { EXPECT_NEAR(ours.line_at(i), whole.line_at(i + cut), 2.0) << i; }
}

/// A path in steps of 0.1 mm as a trajectory without lines.
struct Walked {
    std::vector<double> axis[3];

    void go(const Vec3& from, const Vec3& to) {
        const auto n = static_cast<int>(std::ceil((to - from).norm() / 0.1));
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < 3; ++k) axis[k].push_back((from + (to - from) * i / n)[k]);
        }
    }
    [[nodiscard]] PointIndex size() const { return static_cast<PointIndex>(axis[0].size()); }
    [[nodiscard]] Trajectory trajectory() const {
        Trajectory path;
        path.count = size();
        path.period = 0.001;
        path.name = "walked";
        for (std::size_t k = 0; k < 3; ++k) {
            path.axes[k] = {reinterpret_cast<const std::byte*>(axis[k].data()),
                            sizeof(double),
                            path.count,
                            ScalarType::f64,
                            false,
                            1.0,
                            0.0};
        }
        return path;
    }
};

TEST(LineMap, GoesOnBehindAWayThatIsNoneOfTheProgramsOwn) {
    // Line k + 2 is the pass at Y k. The run is stopped on line 8, goes up and back, and is resumed on line 5.
    std::string text = "G0 X0 Y0 Z0\nG1 F600\n";
    for (int k = 1; k <= 9; ++k) text += fmt::format("X{} Y{}\n", k % 2 == 1 ? 30 : 0, k);
    const Program program = parse_program(SourceText("test.nc", text, nullptr), {});
    const auto end_of = [](int line) {
        return line < 3 ? Vec3(0, 0, 0) : Vec3((line - 2) % 2 == 1 ? 30 : 0, line - 2, 0);
    };
    Walked log;
    for (int line = 3; line <= 7; ++line) log.go(end_of(line - 1), end_of(line));
    const Vec3 stop = 0.5 * (end_of(7) + end_of(8));
    log.go(end_of(7), stop);
    const Vec3 up(0, 0, 40);
    log.go(stop, stop + up);
    log.go(stop + up, end_of(4) + up);
    log.go(end_of(4) + up, end_of(4));
    const PointIndex resumed = log.size();
    std::vector<PointIndex> ends;
    for (int line = 5; line <= 11; ++line) {
        log.go(end_of(line - 1), end_of(line));
        ends.push_back(log.size());
    }
    Diagnostics diagnostics;
    const LineMap lines = align_lines(log.trajectory(), program, diagnostics);
    EXPECT_EQ(diagnostics.count("map.resumed"), 1u);
    EXPECT_EQ(diagnostics.count("map.lost"), 1u);
    PointIndex begin = resumed;
    for (int line = 5; line <= 11; ++line) {
        const PointIndex end = ends[static_cast<std::size_t>(line - 5)];
        EXPECT_EQ(lines.line_at((begin + end) / 2), static_cast<LineNumber>(line));
        begin = end;
    }
}

/// The events of a program as its motions are followed: tip control, feed mode, path mode, tool, one motion after
/// another.
std::vector<std::string> seen_of_events(const Program& program) {
    const auto motions = static_cast<std::size_t>(program.motions.size());
    const LineMap map(Column<std::uint32_t>(motions, 0), Column<std::uint8_t>(motions, 0), program);
    ToolCentrePoint tip(program);
    FeedModeCursor feed(program);
    std::vector<std::string> seen;
    for (std::int64_t m = 0; m < program.motions.size(); ++m) {
        seen.push_back(fmt::format("{} {} {} {}", tip.on(m), feed.per_minute(m), feed.inverse_time(m), map.tool_of(m)));
    }
    seen.push_back(fmt::format("{:.3f} {}", corner_tolerance(program), map.one_tool()));
    return seen;
}

Program fanuc_program(std::string_view text) {
    InterpreterOptions options;
    options.dialect = find_dialect("fanuc");
    return parse_program(SourceText("part.nc", text, nullptr), options);
}

TEST(Events, LongToolNumbersAreDifferentTools) {
    const Program program = fanuc_program("G21 G90 T1234567 M6\nG1 X1 F100\nT1234568 M6\nX2\nT1234567 M6\nX3\nM30\n");
    const LineMap map(Column<std::uint32_t>(3, 0), Column<std::uint8_t>(3, 0), program);
    EXPECT_EQ(map.tool_of(0), 1U);
    EXPECT_EQ(map.tool_of(1), 2U);
    EXPECT_EQ(map.tool_of(2), 1U);
}

TEST(Events, MeanWhatTheyAreNotWhatTheirTextSays) {
    Program program = fanuc_program(
        "G21 G90 T1 M6\nG0 X0 Y0 Z0\nG43.4 H1\nG1 X1 F100\nG49\nG93 X2 F5\n"
        "G94 G64 P0.02\nT2 M6\nX3 F100\nG43.5 H2\nX4\nG68.2 X0 Y0 Z0\nX5\nM30\n");
    const std::vector<std::string> before = seen_of_events(program);
    EXPECT_EQ(before.front(), "false true false 1");
    EXPECT_EQ(before.at(1), "true true false 1");
    EXPECT_EQ(before.at(2), "false false true 1");
    EXPECT_EQ(before.at(3), "false true false 2");
    EXPECT_EQ(before.at(4), "true true false 2");
    for (ProgramEvent& event : program.events) {
        event.name = event.name == "tool" ? "tool-centre-point" : "tool";
        event.value = "G43.4";
    }
    EXPECT_EQ(seen_of_events(program), before);
}

}  // namespace
}  // namespace clsurf::line_map_test
