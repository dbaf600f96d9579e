#include "io/files/sha256.h"

#include <array>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/error.h"

namespace clsurf::io {

std::string sha256(std::span<const std::byte> bytes) {
    std::array<unsigned char, 32> digest{};
    unsigned size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1 ||
        size != digest.size())
        throw SystemError("OpenSSL does not compute SHA-256");
    return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace clsurf::io
