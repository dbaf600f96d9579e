// Sections of consecutive records: a step that no axis can make ends a section.

#include "identify/axis_record.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "log/log.h"

namespace clsurf::axis_record_test {
namespace {

std::vector<PointRange> sections_of(const std::vector<double>& values, double period) {
    Log log;
    log.records = static_cast<PointIndex>(values.size());
    log.period = period;
    const ChannelView view = view_of(values);
    return find_sections(log, {&view, 1});
}

/// 0.1 mm per record.
std::vector<double> ramp(std::size_t count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(0.1 * static_cast<double>(i));
    return values;
}

// A counter that restarts after 360: the step of the motion continues after it.
TEST(AxisRecord, ACounterThatBeginsAgainEndsASection) {
    std::vector<double> values = ramp(100);
    for (std::size_t i = 40; i < values.size(); ++i) values[i] -= 360;
    const std::vector<PointRange> sections = sections_of(values, 0.002);
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ(sections[0].last, 39);
    EXPECT_EQ(sections[1].first, 40);
}

// The jump is where two blocks of records meet, which are read one after the other.
TEST(AxisRecord, AJumpBetweenTwoBlocksEndsASection) {
    std::vector<double> values = ramp(40000);
    for (std::size_t i = 16384; i < values.size(); ++i) values[i] += 5;
    const std::vector<PointRange> sections = sections_of(values, 0.001);
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ(sections[1].first, 16384);
}

// From rest to 12 m/min in one step, as kernels without a jerk limit start: 0.2 mm in a record of 1 ms is 20 g, but the
// motion continues.
TEST(AxisRecord, AMotionThatBeginsAtOnceIsNoJump) {
    std::vector<double> values(50, 0.0);
    for (const double value : ramp(50)) values.push_back(2 * value);
    EXPECT_EQ(sections_of(values, 0.001).size(), 1U);
}

// A recorder that loses one record in a thousand: the sample has as many records as without.
TEST(AxisRecord, ASampleOfShortSectionsHasTheWantedSize) {
    std::vector<PointRange> sections;
    for (PointIndex first = 0; first < 2'000'000; first += 1000) sections.push_back({first, first + 998});
    const std::vector<PointRange> pieces = sample_pieces(sections, 1'000'000);
    PointIndex records = 0;
    for (const PointRange& piece : pieces) records += piece.size();
    EXPECT_NEAR(static_cast<double>(records), 1e6, 1000);
    // Evenly spaced: half of them in the first half.
    const auto first_half =
        std::count_if(pieces.begin(), pieces.end(), [](const PointRange& p) { return p.first < 1'000'000; });
    EXPECT_NEAR(static_cast<double>(first_half), 0.5 * static_cast<double>(pieces.size()), 1);
}

}  // namespace
}  // namespace clsurf::axis_record_test
