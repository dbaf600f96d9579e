#pragma once
// Which dialect a program is written in, by the words that only one of them writes and by the file's ending.

#include <string>
#include <string_view>

#include "program/dialect.h"

namespace clsurf {

struct DialectGuess {
    const Dialect* dialect = nullptr;
    std::string reason;  ///< "'#<' in line 11, the ending .ngc"
};

/// The dialect that most signs speak for; `fanuc` where none does. `name`: of the file, its ending is a sign as well.
/// Looks at the first 200,000 bytes. O(bytes).
[[nodiscard]] DialectGuess guess_dialect(std::string_view text, std::string_view name = {});

}  // namespace clsurf
