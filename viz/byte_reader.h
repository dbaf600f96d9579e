#pragma once
// Reads values from a sequence of bytes in their in-memory form.

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace clsurf::viz {

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

template <typename T>
void append_bytes(std::string& bytes, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

/// Takes values from the front; false: not enough bytes.
template <typename T, std::size_t Size>
bool take_bytes(std::string_view& bytes, std::span<T, Size> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes.size() < values.size_bytes()) return false;
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size_bytes());
    bytes.remove_prefix(values.size_bytes());
    return true;
}

}  // namespace clsurf::viz
