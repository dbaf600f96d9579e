#include "io/reports/line_ranges.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "io/reports/defect_names.h"

namespace clsurf::io::line_ranges_test {
namespace {

DefectSection run(LineNumber first, LineNumber last) { return {1, {0, 1}, first, last}; }

Defect defect_of(std::vector<DefectSection> runs) {
    Defect defect;
    defect.sections = std::move(runs);
    return defect;
}

TEST(LineRanges, NamesEachLineOnce) {
    // Three passes of a loop that runs the same lines.
    EXPECT_EQ(line_ranges(defect_of({run(12, 13), run(12, 13), run(12, 13)}), 4), "12-13");
    EXPECT_EQ(line_ranges(defect_of({run(30, 34), run(9, 9), run(33, 36), run(0, 0)}), 4), "30-36, 9");
    EXPECT_EQ(line_ranges(defect_of({run(1, 1), run(3, 3), run(5, 5)}), 2), "1, 3 and 1 more");
    EXPECT_EQ(line_ranges(defect_of({run(0, 0)}), 4), "-");
    EXPECT_EQ(line_ranges(defect_of({run(20, 4)}), 4), "4-20");
}

TEST(LineRanges, BeginWithTheStrongestSection) {
    Defect defect = defect_of({run(1, 3), run(7, 8), run(8, 9), run(20, 20)});
    defect.sections[2].points = {50, 60};
    defect.point = 55;
    EXPECT_EQ(line_ranges(defect, 2), "7-9, 1-3 and 1 more");
    EXPECT_EQ(lines_label(defect), "lines 7–9, 3 sections") << "a map names the same";
    defect.point = 99;
    EXPECT_EQ(line_ranges(defect, 2), "1-3, 7-9 and 1 more") << "the strongest one was not kept";
}

TEST(LineRanges, SayLineOfOneAndLinesOfMore) {
    EXPECT_EQ(named_line_ranges(defect_of({run(16, 16), run(16, 16)}), 4), "line 16");
    EXPECT_EQ(named_line_ranges(defect_of({run(16, 17)}), 4), "lines 16-17");
    EXPECT_EQ(named_line_ranges(defect_of({run(1, 1), run(3, 3)}), 1), "line 1 and 1 more range");
    EXPECT_EQ(named_line_ranges(defect_of({run(1, 2), run(4, 5), run(7, 8)}), 1), "lines 1-2 and 2 more ranges");
    EXPECT_EQ(named_line_ranges(defect_of({run(1, 1), run(3, 3), run(5, 5), run(7, 9)}), 2),
              "lines 1, 3 and 2 more ranges");
    EXPECT_EQ(named_line_ranges(defect_of({run(0, 0)}), 4), "no known line");
    DefectSection called = run(16, 16);
    called.file = "ramp.nc";
    called.file_first_line = 3;
    called.file_last_line = 9;
    EXPECT_EQ(named_line_ranges(defect_of({called}), 4), "line 16 (in ramp.nc: 3-9)");
}

}  // namespace
}  // namespace clsurf::io::line_ranges_test
