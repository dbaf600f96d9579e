#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "program/dialect.h"
#include "program/dialects/known_dialects.h"
#include "program/text/block.h"

namespace clsurf {
std::span<const Dialect> dialects() {
    static const auto table = std::to_array<Dialect>({
#define DIALECT(name, sources) name##_dialect,
#include "program/dialects/dialects.def"
#undef DIALECT
    });
    return table;
}

const Dialect* find_dialect(std::string_view name) {
    const auto found = std::ranges::find(dialects(), name, &Dialect::name);
    return found == dialects().end() ? nullptr : &*found;
}

std::string where_code_is_known(int code) {
    if (code >= 5_g && code <= 5.3_g)
        return fmt::format("{} is a spline of linuxcnc: --dialect linuxcnc", code_text(code));
    if (code == 6.2_g) return "G6.2 is a NURBS of fanuc and linuxcnc: --dialect";
    if (code >= 6.1_g && code <= 6.3_g)
        return "splines by G6.1 and G6.3 are not supported: let the CAM system write lines";
    return {};
}

}  // namespace clsurf
