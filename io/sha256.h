#pragma once
// SHA-256 (FIPS 180-4): which program a log belongs to, as BIIP metadata names it.

#include <cstddef>
#include <span>
#include <string>

namespace clsurf::io {

/// 64 hexadecimal digits, lower case. Takes the machine's own instructions where it has them;
/// `plain`: not even then (tests compare the two).
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes, bool plain = false);

}  // namespace clsurf::io
