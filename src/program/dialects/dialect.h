#pragma once
// Dialect: which controller's language a program is written in. The same word means different things
// (G5, G5.1, G8 are splines and lathe radius in LinuxCNC, high-speed modes in Fanuc).

#include <cstdint>
#include <span>
#include <string_view>

namespace clsurf {

enum class DialectId : std::uint8_t { fanuc, siemens, linuxcnc, heidenhain_iso };

struct Dialect {
    DialectId id;
    std::string_view name;     ///< "fanuc", the word of --dialect
    std::string_view summary;  ///< one line for `clsurf help dialects`
};

/// All dialects, in the order of the help text.
[[nodiscard]] std::span<const Dialect> dialects();

/// The dialect of that name, or nullptr.
[[nodiscard]] const Dialect* find_dialect(std::string_view name);

}  // namespace clsurf
