#include <gtest/gtest.h>

#include "core/queue.h"

namespace clsurf::queue_test {
namespace {

TEST(Queue, KeepsTheOrderWhileItsItemsMove) {
    Queue<int> queue;
    int next = 0, first = 0;
    for (int round = 0; round < 200; ++round) {
        for (int k = 0; k < round % 7; ++k) queue.push_back(next++);
        for (int k = 0; k < round % 5 && !queue.empty(); ++k) {
            EXPECT_EQ(queue.front(), first++);
            queue.pop_front();
        }
        ASSERT_EQ(queue.size(), static_cast<std::size_t>(next - first));
        for (std::size_t i = 0; i < queue.size(); ++i) ASSERT_EQ(queue[i], first + static_cast<int>(i));
        if (!queue.empty()) { ASSERT_EQ(queue.back(), next - 1); }
    }
    queue.clear();
    EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace clsurf::queue_test
