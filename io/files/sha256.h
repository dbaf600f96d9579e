#pragma once
// SHA-256 (FIPS 180-4), by OpenSSL: which program a log belongs to, as BIIP metadata names it.

#include <cstddef>
#include <span>
#include <string>

namespace clsurf::io {

/// 64 hexadecimal digits, lower case. Throws SystemError where OpenSSL does not offer it.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);

}  // namespace clsurf::io
