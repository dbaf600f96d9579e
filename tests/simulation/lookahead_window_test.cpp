#include "simulation/plan/lookahead_window.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf::lookahead_window_test {
namespace {

Span span_of(std::int64_t block, double length = 1) {
    Span span;
    span.base.block = block;
    span.length = length;
    return span;
}

LookaheadWindow window_of(std::int64_t blocks, double distance = 0, int replan_blocks = 0) {
    ControllerSettings controller;
    controller.lookahead_distance = distance;
    controller.replan_blocks = replan_blocks;
    return {controller, blocks};
}

TEST(LookaheadWindow, KnowsANumberOfBlocksAfterTheRunningOne) {
    const LookaheadWindow window = window_of(3);
    EXPECT_TRUE(window.takes_more(span_of(10), span_of(10)));
    EXPECT_TRUE(window.takes_more(span_of(10), span_of(12)));
    EXPECT_FALSE(window.takes_more(span_of(10), span_of(13)));
}

TEST(LookaheadWindow, KnowsADistanceAfterTheRunningBlock) {
    // 5 mm: the running block has 4, which do not count; 3 + 1.5 are less, 3 + 1.5 + 0.5 are not.
    LookaheadWindow window = window_of(100, 5);
    std::vector<Span> spans{span_of(10, 3), span_of(10, 1), span_of(11, 3), span_of(12, 1.5)};
    window.begin(spans);
    EXPECT_TRUE(window.takes_more(spans.front(), spans.back()));
    spans.push_back(span_of(12, 0.5));
    window.count(spans.front(), spans.back());
    EXPECT_FALSE(window.takes_more(spans.front(), spans.back()));
    // Block 10 has run: of the rest, 2 mm are after the running block.
    spans.erase(spans.begin(), spans.begin() + 2);
    window.begin(spans);
    EXPECT_TRUE(window.takes_more(spans.front(), spans.back()));
    window.count(spans.front(), span_of(13, 3));
    EXPECT_FALSE(window.takes_more(spans.front(), span_of(13, 3)));
}

TEST(LookaheadWindow, RunsHalfOfTheKnownBlocksOrAsManyAsTheControllerSays) {
    EXPECT_EQ(window_of(10).first_kept(span_of(20), span_of(26)), 23);
    EXPECT_EQ(window_of(10).first_kept(span_of(20), span_of(27)), 23);
    EXPECT_EQ(window_of(4).first_kept(span_of(20), span_of(26)), 22) << "of four known blocks";
    // At least the running block.
    EXPECT_EQ(window_of(10).first_kept(span_of(20), span_of(21)), 21);
    EXPECT_EQ(window_of(10).first_kept(span_of(20), span_of(20)), 21);
    EXPECT_EQ(window_of(10, 0, 5).first_kept(span_of(20), span_of(26)), 25);
    EXPECT_EQ(window_of(10, 0, 1).first_kept(span_of(20), span_of(30)), 21);
}

}  // namespace
}  // namespace clsurf::lookahead_window_test
