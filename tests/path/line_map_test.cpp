// Alignment without a line channel, judged by the kernel's own line numbers: a point's line is right
// if it lies between the kernel's previous reported line and the reported one, one line more allowed
// (a kernel reports the last line of what it merged, and changes the number where a blend begins).
#include "path/line_map.h"

#include <gtest/gtest.h>

#include "io/log_format.h"
#include "io/program_file.h"
#include "path/alignment.h"

namespace clsurf {
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
                         testing::Values(Sample{"bottle_uneven.nc", "bottle_uneven.biip"}, Sample{"bottle_zigzag.nc", "bottle_zigzag.biip"},
                                         Sample{"dome_loops.nc", "dome_loops.biip"}, Sample{"transition_g61.nc", "transition_g61.biip"},
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
    for (const PointIndex i : {0, 500, 5000}) {
        EXPECT_NEAR(ours.line_at(i), whole.line_at(i + cut), 2.0) << i;
    }
}

}  // namespace
}  // namespace clsurf
