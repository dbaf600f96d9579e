#include "core/block_fill.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "core/column.h"

namespace clsurf {
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
}  // namespace clsurf
