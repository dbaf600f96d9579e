// Shifts of lines, with records that are counted out here.
#include "mapping/line_shifts.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::line_shifts_test {
namespace {

/// Lines from 10 on with a given number of records each; their numbers in the text that was run and in the present text.
struct Recorded {
    std::vector<int> records;
    std::vector<LineNumber> ran, now;
    std::int64_t lead = 0;

    /// Appends lines of `count` records each. If the shift is smaller than before, comments were deleted in front of them.
    void add(int lines, int count, std::int64_t shift) {
        for (int k = 0; k < lines; ++k) {
            const std::int64_t deleted =
                ran.empty() ? 0 : std::max<std::int64_t>(0, std::int64_t{now.back()} - ran.back() - shift);
            const std::int64_t line = ran.empty() ? 10 : ran.back() + 1 + deleted;
            records.push_back(count);
            ran.push_back(static_cast<LineNumber>(line));
            now.push_back(static_cast<LineNumber>(line + shift));
        }
    }

    [[nodiscard]] LineShifts shifts() const {
        Column<LineNumber> found;
        std::vector<LineEnd> ends;
        for (std::size_t k = 0; k < records.size(); ++k) {
            for (int i = 0; i < records[k]; ++i) found.push_back(now[k]);
            if (k + 1 == records.size()) break;
            const auto end = static_cast<std::int64_t>(found.size());
            ends.push_back({ran[k], std::max<std::int64_t>(0, end - lead), std::min(records[k], records[k + 1]) / 2.0});
        }
        return find_line_shifts(ends, found, now);
    }
};

using Sections = std::vector<std::pair<LineNumber, std::int64_t>>;  ///< first line and shift

Sections sections(const LineShifts& shifts) {
    Sections all;
    for (const ShiftedLines& s : shifts.sections) all.emplace_back(s.first, s.shift);
    return all;
}

// Thirty lines of one record each end within a lead of two records, and any shift of up to two lines would fit there.
TEST(LineShifts, LinesShorterThanTheLeadAreNoEdit) {
    for (const std::int64_t lead : {-3, -2, -1, 0, 1, 2, 3, 6}) {
        Recorded log;
        log.lead = lead;
        log.add(20, 12, 0);
        log.add(30, 1, 0);
        log.add(20, 12, 0);
        const LineShifts shifts = log.shifts();
        EXPECT_EQ(sections(shifts), Sections{}) << "lead " << lead;
        EXPECT_LT(shifts.unexplained, 0.05) << "lead " << lead;
    }
}

// A line inserted before the short ones is only visible after them, and placed at the first long one at the latest.
TEST(LineShifts, AnEditAmongShortLinesIsFound) {
    for (const std::int64_t lead : {-1, 0, 1, 2, 3}) {
        Recorded log;
        log.lead = lead;
        log.add(20, 12, 0);
        log.add(15, 1, 0);
        log.add(15, 1, 1);
        log.add(20, 12, 1);
        const Sections found = sections(log.shifts());
        ASSERT_EQ(found.size(), 1u) << "lead " << lead;
        EXPECT_EQ(found[0].second, 1) << "lead " << lead;
        EXPECT_GE(found[0].first, 30u) << "lead " << lead;
        EXPECT_LE(found[0].first, 60u) << "lead " << lead;
    }
}

// Lines of 12, 9, 17, 12, 9, 17 … records: no other lead looks like a shift.
TEST(LineShifts, EachEditIsFoundAtItsLine) {
    for (const std::int64_t lead : {-2, 0, 2, 4}) {
        Recorded log;
        log.lead = lead;
        const auto uneven = [&](int lines, std::int64_t shift) {
            for (int k = 0; k < lines; ++k) log.add(1, std::vector{12, 9, 17}[static_cast<std::size_t>(k % 3)], shift);
        };
        uneven(21, 2);
        uneven(21, 3);
        uneven(21, -1);
        // Lines 10 … 30, 31 … 51 and 56 … 76: two inserted in front, one before line 31, 52 … 55 deleted.
        EXPECT_EQ(sections(log.shifts()), (Sections{{10, 2}, {31, 3}, {56, -1}})) << "lead " << lead;
    }
}

// The numbers of another program never agree.
TEST(LineShifts, AnotherNumberingIsUnexplained) {
    Recorded log;
    log.add(60, 10, 0);
    for (std::size_t k = 0; k < log.ran.size(); ++k) log.ran[k] = static_cast<LineNumber>(10 * k + 10);
    EXPECT_GT(log.shifts().unexplained, 0.5);
}

}  // namespace
}  // namespace clsurf::line_shifts_test
