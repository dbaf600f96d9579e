#include "io/page/page_policy.h"

#include "io/files/sha256.h"
#include "io/page/page_pack.h"

namespace clsurf::io {

std::string source_hash(std::string_view text) {
    const std::string digits = sha256(std::as_bytes(std::span(text.data(), text.size())));
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    return "'sha256-" + to_base64(bytes) + "'";
}

}  // namespace clsurf::io
