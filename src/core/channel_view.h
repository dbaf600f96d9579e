#pragma once
// ChannelView: a typed strided view of one channel of a log, without a copy. value = raw · scale + bias.
//
// The mapped file owns the raw data. Per-point code gathers a block of it into doubles with copy_block(), the only
// function that depends on the type of a channel.

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/point.h"

namespace clsurf {

/// Storage types of a channel; the numbers are those of the BIIP format, version 1.
enum class ScalarType : std::uint8_t { i8 = 1, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

/// Bytes of one value of the type.
[[nodiscard]] std::size_t size_of(ScalarType type);

struct ChannelView {
    const std::byte* first = nullptr;  ///< value of point 0; need not be aligned
    std::size_t stride = 0;            ///< bytes from one point to the next
    PointIndex count = 0;              ///< points
    ScalarType type = ScalarType::f64;
    bool big_endian = false;
    double scale = 1.0;
    double bias = 0.0;

    /// raw · scale + bias of one point. Domain: 0 ≤ i < count.
    [[nodiscard]] double at(PointIndex i) const;
};

/// A view of values in memory, which must outlive it.
[[nodiscard]] ChannelView view_of(std::span<const float> values);
[[nodiscard]] ChannelView view_of(std::span<const double> values);
[[nodiscard]] ChannelView view_of(std::span<const std::uint32_t> values);

/// A view of `count` points with the same value, which must outlive it.
[[nodiscard]] ChannelView repeated_view(const double& value, PointIndex count);
[[nodiscard]] ChannelView repeated_view(const std::uint32_t& value, PointIndex count);

/// Gathers points [begin, begin + out.size()) as doubles. Domain: inside the view.
void copy_block(const ChannelView& view, PointIndex begin, std::span<double> out);

/// Gathers an integral channel (a line number) without conversion to double. Values outside 0 … 2^32−1 and values
/// that are not finite become `bad`.
void copy_block(const ChannelView& view, PointIndex begin, std::span<std::uint32_t> out, std::uint32_t bad);

}  // namespace clsurf
