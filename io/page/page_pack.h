#pragma once
// The data of a page besides its text: columns of integers and text, packed so that the browser
// unpacks them without a library: base64 of a zlib stream (RFC 1950, the "deflate" of
// DecompressionStream).
//
// Integers are stored as differences of order 0, 1 or 2 between values `stride` apart. Zigzag coding maps
// small values of either sign to small ones (0, −1, 1, −2, … → 0, 1, 2, 3, …). Their bytes are stored in planes: all
// lowest bytes, then all next ones.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace clsurf::io {

struct PackedColumn {
    std::size_t count = 0;  ///< values
    int order = 0;          ///< order of the differences
    int stride = 1;
    int planes = 0;  ///< bytes per value, 0 … 8
    std::string base64;
};

/// |values| < 2^53: a browser represents them exactly.
[[nodiscard]] PackedColumn pack_integers(std::span<const std::int64_t> values, int stride = 1);
/// One plane, no differences: flags, text.
[[nodiscard]] PackedColumn pack_bytes(std::string_view bytes);

/// RFC 4648, with padding.
[[nodiscard]] std::string to_base64(std::string_view bytes);

}  // namespace clsurf::io
