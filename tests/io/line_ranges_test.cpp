#include "io/reports/line_ranges.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf::io {
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

}  // namespace
}  // namespace clsurf::io
