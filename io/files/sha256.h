#pragma once
// SHA-256 (FIPS 180-4) with OpenSSL. BIIP metadata identify the program of a log by its SHA-256.

#include <cstddef>
#include <span>
#include <string>

namespace clsurf::io {

/// 64 hexadecimal digits, lower case. Throws SystemError if OpenSSL does not offer SHA-256.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);

}  // namespace clsurf::io
