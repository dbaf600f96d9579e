#pragma once
// Detects the dialect of a program, by the words that only one dialect has and by the file's ending.

#include <string>
#include <string_view>

#include "program/dialect.h"

namespace clsurf {

struct DialectGuess {
    const Dialect* dialect = nullptr;
    std::string reason;  ///< "'#<' in line 11, the ending .ngc"
};

/// The dialect with the most signs; `fanuc` if there are none. `name`: of the file; its ending is a sign as well.
/// Reads the first 200,000 bytes. O(bytes).
[[nodiscard]] DialectGuess guess_dialect(std::string_view text, std::string_view name = {});

}  // namespace clsurf
