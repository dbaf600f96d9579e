#include "io/crc32c.h"

#include <array>

namespace clsurf::io {
namespace {

constexpr std::array<std::uint32_t, 256> make_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int k = 0; k < 8; ++k) c = (c & 1u) != 0 ? (c >> 1) ^ 0x82F63B78u : c >> 1;
        table[n] = c;
    }
    return table;
}

constexpr std::array<std::uint32_t, 256> byte_table = make_table();

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t crc) {
    crc = ~crc;
    for (const std::byte b : bytes) crc = byte_table[(crc ^ static_cast<std::uint32_t>(b)) & 0xffu] ^ (crc >> 8);
    return ~crc;
}

}  // namespace clsurf::io
