#include "io/files/crc32c.h"

#include <boost/crc.hpp>

namespace clsurf::io {

std::uint32_t crc32c(std::initializer_list<std::span<const std::byte>> pieces) {
    boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;
    for (const std::span<const std::byte> piece : pieces) crc.process_bytes(piece.data(), piece.size());
    return crc.checksum();
}

}  // namespace clsurf::io
