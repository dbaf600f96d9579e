#include "io/formats/line_events.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace clsurf::io::line_events_test {
namespace {

std::vector<LineNumber> lines_at(const std::vector<double>& clock) {
    std::vector<LineEvent> events{{3, 30, 0}, {1, 10, 0}, {2, 20, 0}};
    std::vector<LineNumber> lines;
    for_each_event(
        events, static_cast<PointIndex>(clock.size()), [&](PointIndex i) { return clock[static_cast<std::size_t>(i)]; },
        [&](PointIndex, const LineEvent* event) { lines.push_back(event == nullptr ? 0 : event->line); });
    return lines;
}

using Lines = std::vector<LineNumber>;

TEST(LineEvents, EachPointHasTheLastEventBeforeIt) {
    EXPECT_EQ(lines_at({0, 1, 1.5, 2, 9}), (Lines{0, 10, 10, 20, 30}));
}

TEST(LineEvents, AClockThatFallsFindsEarlierEventsAgain) {
    EXPECT_EQ(lines_at({3, 0.5, 1, 3}), (Lines{30, 0, 10, 30}));
    EXPECT_EQ(lines_at({2.1, 1.9, 2.2, 1.8}), (Lines{20, 10, 20, 10})) << "it jitters";
}

TEST(LineEvents, APointWithoutTimeHidesNoFall) {
    EXPECT_EQ(lines_at({3, std::numeric_limits<double>::quiet_NaN(), 1}), (Lines{30, 30, 10}));
}

}  // namespace
}  // namespace clsurf::io::line_events_test
