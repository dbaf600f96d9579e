#pragma once
// UTF-8 of foreign files, decoded one code point at a time.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace clsurf {

struct CodePoint {
    std::uint32_t value = 0;
    std::size_t size = 0;  ///< bytes; 0: no UTF-8
};

/// The code point at the beginning of a text, by the table of well-formed sequences (Unicode 15, table 3-7).
[[nodiscard]] CodePoint first_code_point(std::string_view text);

}  // namespace clsurf
