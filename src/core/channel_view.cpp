#include "core/channel_view.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace clsurf {
namespace {

template <typename T>
T swap_bytes(T value) {
    if constexpr (sizeof(T) == 1) {
        return value;
    } else if constexpr (sizeof(T) == 2) {
        return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
    } else if constexpr (sizeof(T) == 4) {
        return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
    } else {
        return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
    }
}

template <typename T, bool swapped>
T load(const std::byte* place) {
    T value;
    std::memcpy(&value, place, sizeof value);
    return swapped ? swap_bytes(value) : value;
}

template <typename T, bool swapped>
void gather(const ChannelView& view, PointIndex begin, std::span<double> out) {
    const std::byte* place = view.first + static_cast<std::size_t>(begin) * view.stride;
    const double scale = view.scale;
    const double bias = view.bias;
    if (scale == 1.0 && bias == 0.0) {
        for (double& value : out) {
            value = static_cast<double>(load<T, swapped>(place));
            place += view.stride;
        }
        return;
    }
    for (double& value : out) {
        value = static_cast<double>(load<T, swapped>(place)) * scale + bias;
        place += view.stride;
    }
}

template <typename T, bool swapped>
void gather_unsigned(const ChannelView& view, PointIndex begin, std::span<std::uint32_t> out, std::uint32_t bad) {
    const std::byte* place = view.first + static_cast<std::size_t>(begin) * view.stride;
    const bool plain = view.scale == 1.0 && view.bias == 0.0;
    for (std::uint32_t& value : out) {
        const T raw = load<T, swapped>(place);
        place += view.stride;
        if constexpr (std::is_same_v<T, std::uint32_t>) {
            if (plain) {
                value = raw;
                continue;
            }
        }
        const double real = static_cast<double>(raw) * view.scale + view.bias;
        value = real >= 0.0 && real < 4294967296.0 ? static_cast<std::uint32_t>(real) : bad;
    }
}

/// Calls f.operator()<T>() with the C++ type of `type`: the only switch over channel types.
template <typename F>
auto with_type(ScalarType type, F&& f) {
    switch (type) {
        case ScalarType::i8: return f.template operator()<std::int8_t>();
        case ScalarType::u8: return f.template operator()<std::uint8_t>();
        case ScalarType::i16: return f.template operator()<std::int16_t>();
        case ScalarType::u16: return f.template operator()<std::uint16_t>();
        case ScalarType::i32: return f.template operator()<std::int32_t>();
        case ScalarType::u32: return f.template operator()<std::uint32_t>();
        case ScalarType::i64: return f.template operator()<std::int64_t>();
        case ScalarType::u64: return f.template operator()<std::uint64_t>();
        case ScalarType::f32: return f.template operator()<float>();
        case ScalarType::f64: break;
    }
    return f.template operator()<double>();
}

template <typename T>
ChannelView strided_view(const T* first, std::size_t stride, std::size_t count, ScalarType type) {
    ChannelView view;
    view.first = reinterpret_cast<const std::byte*>(first);
    view.stride = stride;
    view.count = static_cast<PointIndex>(count);
    view.type = type;
    return view;
}

template <typename T>
ChannelView contiguous_view(std::span<const T> values, ScalarType type) {
    return strided_view(values.data(), sizeof(T), values.size(), type);
}

}  // namespace

ChannelView view_of(std::span<const float> values) { return contiguous_view(values, ScalarType::f32); }
ChannelView view_of(std::span<const double> values) { return contiguous_view(values, ScalarType::f64); }
ChannelView view_of(std::span<const std::uint32_t> values) { return contiguous_view(values, ScalarType::u32); }

ChannelView repeated_view(const double& value, PointIndex count) {
    return strided_view(&value, 0, static_cast<std::size_t>(count), ScalarType::f64);
}

ChannelView repeated_view(const std::uint32_t& value, PointIndex count) {
    return strided_view(&value, 0, static_cast<std::size_t>(count), ScalarType::u32);
}

std::size_t size_of(ScalarType type) {
    return with_type(type, []<typename T>() { return sizeof(T); });
}

double ChannelView::at(PointIndex i) const {
    double value = 0.0;
    copy_block(*this, i, std::span<double>(&value, 1));
    return value;
}

void copy_block(const ChannelView& view, PointIndex begin, std::span<double> out) {
    with_type(view.type, [&]<typename T>() {
        view.big_endian ? gather<T, true>(view, begin, out) : gather<T, false>(view, begin, out);
    });
}

void copy_block(const ChannelView& view, PointIndex begin, std::span<std::uint32_t> out, std::uint32_t bad) {
    with_type(view.type, [&]<typename T>() {
        view.big_endian ? gather_unsigned<T, true>(view, begin, out, bad)
                        : gather_unsigned<T, false>(view, begin, out, bad);
    });
}

}  // namespace clsurf
