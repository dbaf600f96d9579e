// Constant-speed intervals of whole programs: effects of rounding, and intervals shared by adjacent passes.

#include "intervals/program_intervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include <fmt/format.h>

#include "intervals/interval_feeds.h"
#include "program/interpreter.h"

namespace clsurf::program_intervals_test {
namespace {

constexpr double wave_length = 30, amplitude = 3, length = 60;

/// A zigzag over z = 3 sin(2π x / 30).
Program wave(double spacing, int passes, int decimals, double amplitude_mm = amplitude) {
    std::string text = "G21 G90 G64 P0.01\nG0 X0 Y0 Z20\nF3000\n";
    const int count = static_cast<int>(std::lround(length / spacing));
    for (int k = 0; k < passes; ++k) {
        for (int i = 0; i <= count; ++i) {
            const double x = spacing * (k % 2 == 0 ? i : count - i);
            text += fmt::format("G1 X{:.{}f} Y{:.1f} Z{:.{}f}\n", x, decimals, 0.3 * k,
                                amplitude_mm * std::sin(2 * std::numbers::pi * x / wave_length), decimals);
        }
    }
    const auto bytes = std::make_shared<std::string>(text + "M2\n");
    return parse_program(SourceText("wave.ngc", *bytes, bytes), {});
}

ProgramIntervals planned(const Program& program, const IntervalRules& rules = {}, const Machine& machine = {}) {
    return plan_intervals(program, build_programmed_surface(program), rules, machine);
}

// Without a scale, rounding to three decimals makes 326 intervals of one pass.
TEST(ProgramIntervals, AreNotMadeByRounding) {
    const ProgramIntervals rounded = planned(wave(0.05, 4, 3)), exact = planned(wave(0.05, 4, 6));
    EXPECT_EQ(rounded.passes, 4);
    EXPECT_LE(rounded.intervals.size(), exact.intervals.size());
    EXPECT_LE(rounded.intervals.size(), 4U * 25);
    for (const ProgramInterval& interval : rounded.intervals)
        EXPECT_LT(interval.greatest_curvature, 1.2 * amplitude * std::pow(2 * std::numbers::pi / wave_length, 2));
}

// x at which intervals of the passes end, in steps of 0.05 mm.
TEST(ProgramIntervals, EndAtTheSamePlacesOnAdjacentPasses) {
    const Program program = wave(0.05, 6, 3);
    std::map<std::int64_t, std::set<long>> ends;
    for (const ProgramInterval& interval : planned(program).intervals) {
        for (std::int64_t i = 0; i < program.motions.size(); ++i) {
            if (program.motions.line[static_cast<std::size_t>(i)] == interval.last_line)
                ends[interval.pass].insert(std::lround(program.motions.end[static_cast<std::size_t>(i)].x / 0.05));
        }
    }
    ASSERT_EQ(ends.size(), 6U);
    std::int64_t shared = 0, all = 0;
    for (std::int64_t pass = 2; pass < 6; ++pass) {
        for (const long end : ends[pass]) {
            ++all;
            for (const long off : {-1L, 0L, 1L}) {
                if (ends[pass + 1].count(end + off) > 0) {
                    ++shared;
                    break;
                }
            }
        }
    }
    EXPECT_GE(static_cast<double>(shared), 0.85 * static_cast<double>(all)) << shared << " of " << all;
}

TEST(ProgramIntervals, AreNoLongerThanTheRulesAllow) {
    IntervalRules rules;
    rules.greatest_length = 5;
    for (const ProgramInterval& interval : planned(wave(0.2, 3, 3, 0), rules).intervals)
        EXPECT_LE(interval.length, 5.3);
    for (const ProgramInterval& interval : planned(wave(0.2, 3, 3, 0)).intervals) EXPECT_GT(interval.length, 50);
}

// The steepest curvature of the wave is 0.1316 /mm: √(a / κ) with a normal acceleration of 100 mm/s² is 27.6 mm/s.
// 4 mm of one pass of a plane have half of the feed. The rest of the pass keeps the feed of its neighbours.
TEST(ProgramIntervals, AFewLinesWithALowerFeedSlowNoOtherLinesDown) {
    std::string text = "G21 G90 G64 P0.01\nG0 X0 Y0 Z20\nF2400\n";
    for (int k = 0; k < 6; ++k) {
        for (int i = 0; i <= 80; ++i) {
            const bool slow = k == 3 && i > 40 && i <= 48;
            text += fmt::format("G1 X{:.1f} Y{:.1f} Z0 F{}\n", 0.5 * (k % 2 == 0 ? i : 80 - i), 0.3 * k,
                                slow ? 1200 : 2400);
        }
    }
    const auto bytes = std::make_shared<std::string>(text + "M2\n");
    const Program program = parse_program(SourceText("plane.ngc", *bytes, bytes), {});
    const ProgramIntervals intervals = planned(program);
    EXPECT_EQ(intervals.intervals.size(), 8U) << "one for each pass, three for that with the slow lines";
    for (std::size_t i = 1; i < intervals.speed_of_motion.size(); ++i) {
        const float speed = intervals.speed_of_motion[i];
        if (!std::isfinite(speed)) continue;
        EXPECT_FLOAT_EQ(speed, program.motions.feed[i]) << "line " << program.motions.line[i];
    }
}

TEST(IntervalFeeds, HoldTheSpeedThatTheCurvatureAllows) {
    Machine machine;
    machine.path.max_normal_acceleration = 100;
    Program program = wave(0.05, 4, 3);
    const std::vector<float> feeds = interval_feeds(program, machine);
    ASSERT_EQ(feeds.size(), static_cast<std::size_t>(program.motions.size()));
    float lowest = 1000;
    for (const float feed : feeds) {
        EXPECT_TRUE(feed == 0 || feed < 50);
        if (feed > 0) lowest = std::min(lowest, feed);
    }
    const double curvature = amplitude * std::pow(2 * std::numbers::pi / wave_length, 2);
    EXPECT_NEAR(lowest, std::sqrt(100 / curvature), 2.0);
    hold_interval_speeds(program, machine);
    for (std::size_t i = 0; i < feeds.size(); ++i) {
        if (feeds[i] > 0) { EXPECT_EQ(program.motions.feed[i], feeds[i]); }
    }
    machine.path.max_normal_acceleration = 1e6;
    machine.path.max_jerk = 1e9;
    for (const float feed : interval_feeds(wave(0.05, 4, 3), machine)) EXPECT_EQ(feed, 0);
}

}  // namespace
}  // namespace clsurf::program_intervals_test
