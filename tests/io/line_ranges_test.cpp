#include "io/reports/line_ranges.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf::io::line_ranges_test {
namespace {

DefectRun run(LineNumber first, LineNumber last) { return {1, {0, 1}, first, last}; }

TEST(LineRanges, NamesEachLineOnce) {
    // Three passes of a loop that runs the same lines.
    EXPECT_EQ(line_ranges(std::vector{run(12, 13), run(12, 13), run(12, 13)}, 4), "12-13");
    EXPECT_EQ(line_ranges(std::vector{run(30, 34), run(9, 9), run(33, 36), run(0, 0)}, 4), "9, 30-36");
    EXPECT_EQ(line_ranges(std::vector{run(1, 1), run(3, 3), run(5, 5)}, 2), "1, 3 and 1 more");
    EXPECT_EQ(line_ranges(std::vector{run(0, 0)}, 4), "-");
    EXPECT_EQ(line_ranges(std::vector{run(20, 4)}, 4), "4-20");
}

TEST(LineRanges, SayLineOfOneAndLinesOfMore) {
    EXPECT_EQ(named_line_ranges(std::vector{run(16, 16), run(16, 16)}, 4), "line 16");
    EXPECT_EQ(named_line_ranges(std::vector{run(16, 17)}, 4), "lines 16-17");
    EXPECT_EQ(named_line_ranges(std::vector{run(1, 1), run(3, 3)}, 1), "line 1 and 1 more range");
    EXPECT_EQ(named_line_ranges(std::vector{run(1, 2), run(4, 5), run(7, 8)}, 1), "lines 1-2 and 2 more ranges");
    EXPECT_EQ(named_line_ranges(std::vector{run(1, 1), run(3, 3), run(5, 5), run(7, 9)}, 2),
              "lines 1, 3 and 2 more ranges");
    EXPECT_EQ(named_line_ranges(std::vector{run(0, 0)}, 4), "no known line");
    DefectRun called = run(16, 16);
    called.file = "ramp.nc";
    called.file_first_line = 3;
    called.file_last_line = 9;
    EXPECT_EQ(named_line_ranges(std::vector{called}, 4), "line 16 (in ramp.nc: 3-9)");
}

}  // namespace
}  // namespace clsurf::io::line_ranges_test
