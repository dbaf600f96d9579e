#include "log/held_values.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace clsurf::held_values_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A log of `time` and a channel.
struct Made {
    std::vector<double> times, values;
    Log log;

    Made(std::vector<double> t, std::vector<double> v) : times(std::move(t)), values(std::move(v)) {
        log.records = static_cast<PointIndex>(times.size());
        log.period = 0.1;
        add("time", times);
        add("load", values);
    }
    Made(const Made&) = delete;
    Made& operator=(const Made&) = delete;

private:
    void add(const std::string& name, const std::vector<double>& column) {
        log.channels.push_back({name, "", view_of(column)});
    }
};

std::vector<double> held(const Made& slow, const Made& fast, const HoldRule& rule) {
    return held_values(slow.log, *slow.log.find("load"), fast.log, rule);
}

void expect_equal(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (std::isnan(expected[i]))
            EXPECT_TRUE(std::isnan(found[i])) << i << ": " << found[i];
        else
            EXPECT_EQ(found[i], expected[i]) << i;
    }
}

TEST(HeldValues, AreTheLastOnesByThen) {
    const Made slow({0, 1, 2}, {10, 11, 12});
    const Made fast({0, 0.5, 0.999, 1, 1.001, 2, 2.9}, std::vector<double>(7));
    expect_equal(held(slow, fast, {0, 5}), {10, 10, 10, 11, 11, 12, 12});
}

TEST(HeldValues, EndWithTheirAgeAndBeginWithTheFirst) {
    const Made slow({1, 2, 5}, {11, 12, 15});
    const Made fast({0, 0.999, 1, 2.5, 3.5, 3.75, 4.999, 5, 6.5, 7}, std::vector<double>(10));
    expect_equal(held(slow, fast, {0, 1.5}), {none, none, 11, 12, 12, none, none, 15, 15, none});
}

TEST(HeldValues, PassOverRecordsWithoutAValue) {
    const Made slow({0, 1, 2, 3}, {10, none, 12, std::numeric_limits<double>::infinity()});
    const Made fast({0.5, 1.5, 2.5, 3.5}, std::vector<double>(4));
    expect_equal(held(slow, fast, {0, 2}), {10, 10, 12, 12});
    expect_equal(held(slow, fast, {0, 1}), {10, none, 12, none});
}

TEST(HeldValues, AreFoundByTheOffset) {
    const Made slow({0, 1, 2}, {10, 11, 12});
    const Made fast({0, 1}, std::vector<double>(2));
    expect_equal(held(slow, fast, {1, 1}), {11, 12});
    expect_equal(held(slow, fast, {-1, 1}), {none, 10});
    expect_equal(held(slow, fast, {100, 1}), {none, none});
}

TEST(HeldValues, DoNotNeedTimesThatRise) {
    const Made slow({0, 2, 1, 3}, {10, 12, 99, 13});
    const Made fast({3, 0, none, 2}, std::vector<double>(4));
    expect_equal(held(slow, fast, {0, 1}), {13, 10, none, 12});
}

TEST(HeldValues, CountRecordsWhereThereIsNoTime) {
    const Made slow({0, 1}, {10, 11});
    Made fast(std::vector<double>(20), std::vector<double>(20));
    fast.log.channels.erase(fast.log.channels.begin());  // a record every 0.1 s
    const std::vector<double> values = held(slow, fast, {0.05, 1});
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], i < 10 ? 10 : 11) << i;
}

}  // namespace
}  // namespace clsurf::held_values_test
