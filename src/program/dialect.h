#pragma once
// Dialect: the controller language of a program. The same word means different things (G5, G5.1, G8 are splines and
// lathe radius in LinuxCNC, high-speed modes in Fanuc); the dialect's rules define it (interpret/dialect_rules.h).

#include <span>
#include <string>
#include <string_view>

namespace clsurf {

struct DialectRules;

struct Dialect {
    std::string_view name;                ///< "fanuc", as given to --dialect
    std::string_view summary;             ///< one line for `clsurf help dialects`
    const DialectRules* rules = nullptr;  ///< never null in a dialect that reads programs
};

/// All dialects, in the order of the help text.
[[nodiscard]] std::span<const Dialect> dialects();

/// The dialect of that name, or nullptr.
[[nodiscard]] const Dialect* find_dialect(std::string_view name);

/// A hint for a code (in tenths) that a dialect does not know: the other dialects that have it. Empty: no hint.
[[nodiscard]] std::string where_code_is_known(int code);

}  // namespace clsurf
