#pragma once
// CRC-32C (Castagnoli, polynomial 0x1EDC6F41 reflected), as BIIP's header uses it.

#include <cstddef>
#include <cstdint>
#include <span>

namespace clsurf::io {

/// CRC of `bytes`, going on from `crc` (0 to begin).
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t crc = 0);

}  // namespace clsurf::io
