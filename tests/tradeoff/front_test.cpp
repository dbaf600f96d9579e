// The front and the choice from it, compared with brute force over all pairs, and with values computed by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tradeoff/front.h"

namespace clsurf::front_test {
namespace {

TradeoffRow row(double time, double mismatch, double jerk) {
    TradeoffRow made;
    made.quality.duration = time;
    made.quality.mismatch = mismatch;
    made.quality.jerk = jerk;
    return made;
}

std::vector<TradeoffRow> random_rows(std::mt19937& random, int count, int levels) {
    std::uniform_int_distribution<int> level(1, levels);
    std::vector<TradeoffRow> rows;
    for (int k = 0; k < count; ++k) rows.push_back(row(level(random), level(random), level(random)));
    return rows;
}

/// The definition, written out.
bool is_dominated(const std::vector<TradeoffRow>& rows, std::size_t k) {
    const MotionQuality& q = rows[k].quality;
    return std::ranges::any_of(rows, [&](const TradeoffRow& other) {
        const MotionQuality& p = other.quality;
        const bool no_worse = p.duration <= q.duration && p.mismatch <= q.mismatch && p.jerk <= q.jerk;
        const bool better = p.duration < q.duration || p.mismatch < q.mismatch || p.jerk < q.jerk;
        return no_worse && better;
    });
}

// Few levels give ties and repeated rows, many give large fronts.
TEST(Front, IsWhatBruteForceFinds) {
    std::mt19937 random(24);
    int on_it = 0, off_it = 0;
    for (const int levels : {3, 10, 1000}) {
        for (int round = 0; round < 100; ++round) {
            std::vector<TradeoffRow> rows = random_rows(random, 1 + round, levels);
            mark_front(rows);
            for (std::size_t k = 0; k < rows.size(); ++k) {
                ASSERT_EQ(rows[k].on_front, !is_dominated(rows, k)) << levels << " " << round << " " << k;
                (rows[k].on_front ? on_it : off_it) += 1;
            }
        }
    }
    EXPECT_GT(on_it, 1000);
    EXPECT_GT(off_it, 1000);
}

TEST(Front, LeavesOutWhatIsNotKnown) {
    const double unknown = std::nan("");
    std::vector<TradeoffRow> rows{row(2, 2, 2), row(1, unknown, 1), row(3, 3, 3)};
    mark_front(rows);
    EXPECT_TRUE(rows[0].on_front);
    EXPECT_FALSE(rows[1].on_front);
    EXPECT_FALSE(rows[2].on_front);
    EXPECT_FALSE(dominates(rows[1].quality, rows[2].quality));
}

TEST(Front, EqualRowsAreBothOnIt) {
    std::vector<TradeoffRow> rows{row(1, 2, 3), row(1, 2, 3)};
    mark_front(rows);
    EXPECT_TRUE(rows[0].on_front && rows[1].on_front);
}

// (1 − W) t / t₀ + W (m / m₀ + j / j₀) / 2 of 10 % more time, half the mismatch and 80 % of the jerk: 1.1 at 0, 0.875 at one
// half, 0.65 at 1.
TEST(Weight, CostsWhatThePaperSays) {
    const MotionQuality reference = row(10, 200, 5000).quality, other = row(11, 100, 4000).quality;
    EXPECT_DOUBLE_EQ(weighted_cost(other, reference, 0), 1.1);
    EXPECT_DOUBLE_EQ(weighted_cost(other, reference, 0.5), 0.875);
    EXPECT_DOUBLE_EQ(weighted_cost(other, reference, 1), 0.65);
    for (const double weight : {0.0, 0.3, 1.0}) EXPECT_DOUBLE_EQ(weighted_cost(reference, reference, weight), 1);
}

// A mismatch of 0 mm/min cannot serve as a unit: it must stay at 0, and no rise is accepted.
TEST(Weight, TakesAReferenceWithoutMismatch) {
    const MotionQuality reference = row(10, 0, 5000).quality;
    EXPECT_DOUBLE_EQ(weighted_cost(row(10, 0, 5000).quality, reference, 0.5), 1);
    EXPECT_TRUE(std::isinf(weighted_cost(row(9, 1, 4000).quality, reference, 0.5)));
    EXPECT_DOUBLE_EQ(weighted_cost(row(9, 1, 4000).quality, reference, 0), 0.9);
}

// The first of the order is on the front and no other row costs less, also for the extreme weights.
TEST(Weight, ChoosesFromTheFront) {
    std::mt19937 random(7);
    for (const int levels : {4, 1000}) {
        for (int round = 0; round < 200; ++round) {
            std::vector<TradeoffRow> rows = random_rows(random, 30, levels);
            mark_front(rows);
            for (const double weight : {0.0, 0.1, 0.5, 0.9, 1.0}) {
                const std::vector<std::size_t> order = front_by_weight(rows, weight);
                ASSERT_FALSE(order.empty());
                EXPECT_FALSE(is_dominated(rows, order.front()));
                const double cost = weighted_cost(rows[order.front()].quality, rows[0].quality, weight);
                for (const TradeoffRow& each : rows)
                    EXPECT_LE(cost, weighted_cost(each.quality, rows[0].quality, weight));
                EXPECT_EQ(order.size(),
                          static_cast<std::size_t>(std::ranges::count(rows, true, &TradeoffRow::on_front)));
            }
        }
    }
}

// A higher weight never gives a rougher surface, and never less time.
TEST(Weight, TradesTimeForSurfaceOneWay) {
    std::mt19937 random(11);
    for (int round = 0; round < 50; ++round) {
        std::vector<TradeoffRow> rows = random_rows(random, 40, 1000);
        mark_front(rows);
        double time = 0, surface = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= 20; ++k) {
            const MotionQuality& q = rows[front_by_weight(rows, 0.05 * k).front()].quality;
            const double now = weighted_cost(q, rows[0].quality, 1);
            EXPECT_GE(q.duration, time);
            EXPECT_LE(now, surface + 1e-12);
            time = q.duration;
            surface = now;
        }
    }
}

}  // namespace
}  // namespace clsurf::front_test
