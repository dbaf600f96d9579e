#pragma once
// CRC-32C (Castagnoli, polynomial 0x1EDC6F41 reflected), as BIIP's header uses it.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace clsurf::io {

/// CRC of the concatenated pieces.
[[nodiscard]] std::uint32_t crc32c(std::initializer_list<std::span<const std::byte>> pieces);
[[nodiscard]] inline std::uint32_t crc32c(std::span<const std::byte> bytes) { return crc32c({bytes}); }

}  // namespace clsurf::io
