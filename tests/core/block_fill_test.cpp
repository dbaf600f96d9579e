#include "core/block_fill.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <vector>

#include "core/block_portions.h"
#include "core/column.h"

namespace clsurf::block_fill_test {
namespace {

constexpr PointIndex points = 10 * block_points + 77;

TEST(BlockFill, FillsEveryBlockOnceWhoeverReads) {
    Column<int> values = Column<int>::sparse(static_cast<std::size_t>(points));
    BlockFillPointer fill(points, [out = values.data()](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) ++out[i];
    });
    parallel_for(points, 100, [&](std::int64_t first, std::int64_t last) {
        for (PointIndex i = first; i < last; ++i) {
            const PointIndex elsewhere = (i * 7919) % points;
            fill.need(elsewhere);
            EXPECT_EQ(values[static_cast<std::size_t>(elsewhere)], 1);
        }
    });
    EXPECT_EQ(fill->filled(), points);
}

TEST(BlockFill, FillsWhatIsReadOnly) {
    std::vector<PointIndex> firsts;
    const BlockFillPointer fill(points, [&](PointIndex first, PointIndex) { firsts.push_back(first); });
    fill.need(5);
    fill.need(2 * block_points - 1, 3 * block_points);
    EXPECT_EQ(firsts, (std::vector<PointIndex>{0, block_points, 2 * block_points, 3 * block_points}));
    fill.need(points - 1);
    EXPECT_EQ(fill->filled(), 4 * block_points + 77);
}

TEST(BlockFill, FillsAgainWhatWasForgotten) {
    Column<int> values = Column<int>::sparse(static_cast<std::size_t>(points));
    const BlockFillPointer fill(points, [out = values.data()](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) out[i] += 3;
    });
    fill.need(0);
    EXPECT_EQ(values[0], 3);
    EXPECT_EQ(values[static_cast<std::size_t>(points - 1)], 0) << "zero where nothing was written";
    values.forget();
    fill->forget();
    EXPECT_EQ(values[0], 0);
    fill.need(0);
    EXPECT_EQ(values[0], 3);
}

TEST(BlockFill, OneMayNeedAnother) {
    Column<int> low = Column<int>::sparse(static_cast<std::size_t>(points));
    Column<int> high = Column<int>::sparse(static_cast<std::size_t>(points));
    BlockFillPointer below(points, [out = low.data()](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) out[i] = static_cast<int>(i);
    });
    const BlockFillPointer above(
        points, [from = low.data(), out = high.data(), needed = below.get()](PointIndex first, PointIndex last) {
            for (PointIndex i = first; i < last; ++i) {
                needed->need(points - 1 - i);
                out[i] = from[points - 1 - i];
            }
        });
    parallel_for(points, 1000, [&](std::int64_t first, std::int64_t) { above.need(first); });
    for (PointIndex i = 0; i < points; i += 1001)
        EXPECT_EQ(high[static_cast<std::size_t>(i)], static_cast<int>(points - 1 - i));
}

TEST(BlockFill, ColumnsThatAreFilledWhenReadAreNotCopied) {
    const BlockFillPointer none;
    const BlockFillPointer copy = none;
    EXPECT_FALSE(copy);
    const BlockFillPointer fill(points, [](PointIndex, PointIndex) {});
    EXPECT_THROW(const BlockFillPointer other = fill, std::logic_error);
}

TEST(BlockPortions, LieInFewBlocksAndAreForgottenOneAfterTheOther) {
    // Three in each of 200 blocks, then as many again from the first one on, alternating with those of a pass far away.
    std::vector<PointIndex> looked_at;
    for (PointIndex k = 0; k < 600; ++k) looked_at.push_back(k / 3 * block_points + k % 3);
    for (PointIndex k = 0; k < 600; ++k) looked_at.push_back((k / 6 + k % 2 * 1000) * block_points);
    std::size_t next = 0, portions = 0, forgotten = 0;
    for_each_portion(
        looked_at.size(),
        [&] {
            EXPECT_EQ(++forgotten, portions);
            return true;
        },
        [&](std::size_t k) { return looked_at[k]; },
        [&](std::size_t first, std::size_t end) {
            EXPECT_EQ(first, next);
            std::set<PointIndex> blocks;
            for (std::size_t k = first; k < end; ++k) blocks.insert(looked_at[k] / block_points);
            EXPECT_LE(blocks.size(), 64U);
            next = end;
            ++portions;
        });
    EXPECT_EQ(next, looked_at.size());
    EXPECT_EQ(forgotten, portions);
    // 400 blocks, of which some are shared by two portions.
    EXPECT_GE(portions, 400U / 64);
    EXPECT_LE(portions, 400U / 64 + 4);
}

TEST(BlockPortions, AreOneWhereNothingIsForgotten) {
    std::size_t portions = 0;
    for_each_portion(
        1000, {}, [](std::size_t k) { return static_cast<PointIndex>(k) * block_points; },
        [&](std::size_t first, std::size_t end) {
            ++portions;
            EXPECT_EQ(end - first, 1000U);
        });
    EXPECT_EQ(portions, 1U);
}

TEST(BlockPortions, LookAtAsManyRegionsAtOnceAsThereAreThreads) {
    std::vector<int> seen(11, 0);
    std::size_t forgotten = 0;
    for_each_at_once(
        seen.size(),
        [&] {
            ++forgotten;
            return true;
        },
        [&](std::size_t k) { ++seen[k]; });
    EXPECT_EQ(seen, std::vector<int>(11, 1));
    const auto threads = static_cast<std::size_t>(thread_count());
    EXPECT_EQ(forgotten, (seen.size() + threads - 1) / threads);
}

TEST(Column, BorrowsWhatAnotherOneHolds) {
    Column<int> owner(3, 7);
    {
        const Column<int> guest = Column<int>::borrowed(owner);
        EXPECT_EQ(guest.data(), owner.data());
        Column<int> copy = guest;
        copy[0] = 8;
        copy.push_back(9);
        EXPECT_EQ(guest[0], 7);
    }
    EXPECT_EQ(owner[2], 7);
}

}  // namespace
}  // namespace clsurf::block_fill_test
