#include "core/channel_view.h"

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::channel_view_test {
namespace {

template <typename T>
ChannelView view_of(const std::vector<T>& values, ScalarType type) {
    return {reinterpret_cast<const std::byte*>(values.data()),
            sizeof(T),
            static_cast<PointIndex>(values.size()),
            type,
            false,
            1.0,
            0.0};
}

TEST(ChannelView, AppliesScaleAndBias) {
    const std::vector<std::int32_t> raw{-3, 0, 5'000'000};
    ChannelView view = view_of(raw, ScalarType::i32);
    view.scale = 1e-6;
    view.bias = 2.0;
    EXPECT_DOUBLE_EQ(view.at(0), -3e-6 + 2.0);
    EXPECT_DOUBLE_EQ(view.at(2), 7.0);
}

TEST(ChannelView, ReadsUnalignedRecords) {
    std::array<std::byte, 33> bytes{};
    const double values[2] = {1.5, -2.25};
    for (int i = 0; i < 2; ++i) std::memcpy(bytes.data() + 1 + 16 * i, &values[i], 8);
    const ChannelView view{bytes.data() + 1, 16, 2, ScalarType::f64, false, 1.0, 0.0};
    EXPECT_EQ(view.at(0), 1.5);
    EXPECT_EQ(view.at(1), -2.25);
}

TEST(ChannelView, TurnsBigEndianValues) {
    const std::vector<std::uint16_t> raw{0x0102};  // bytes 02 01 in memory
    ChannelView view = view_of(raw, ScalarType::u16);
    view.big_endian = true;
    EXPECT_EQ(view.at(0), 0x0201);
}

TEST(ChannelView, GivesTheBadValueWhereALineNumberIsNone) {
    const std::vector<double> raw{-1.0, 7.0, 1e20};
    std::array<std::uint32_t, 3> lines{};
    copy_block(view_of(raw, ScalarType::f64), 0, lines, 99);
    EXPECT_EQ(lines, (std::array<std::uint32_t, 3>{99, 7, 99}));
}

TEST(ChannelView, OfValuesInMemoryHasTheirType) {
    const std::vector<float> floats{0.5F, -2};
    const std::vector<double> doubles{1e-300, 3, 7};
    const std::vector<std::uint32_t> lines{4'294'967'295U};
    EXPECT_EQ(clsurf::view_of(floats).at(1), -2);
    EXPECT_EQ(clsurf::view_of(doubles).at(0), 1e-300);
    EXPECT_EQ(clsurf::view_of(doubles).count, 3);
    EXPECT_EQ(clsurf::view_of(lines).at(0), 4'294'967'295.0);
}

TEST(ChannelView, RepeatsAValue) {
    constexpr double value = 0.1;
    const ChannelView view = repeated_view(value, 1'000'000);
    EXPECT_EQ(view.count, 1'000'000);
    std::array<double, 3> last{};
    copy_block(view, view.count - 3, last);
    EXPECT_EQ(last, (std::array<double, 3>{0.1, 0.1, 0.1}));
}

}  // namespace
}  // namespace clsurf::channel_view_test
