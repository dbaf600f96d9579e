#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "program/dialect.h"
#include "program/dialects/known_dialects.h"
#include "program/text/block.h"

namespace clsurf {
namespace {

const std::array<Dialect, 5> table{{
    {"fanuc", "Fanuc, HNC and most others: G-code with custom macro B", &fanuc_rules},
    {"siemens", "SINUMERIK: X=AC(…), TRAORI, CYCLE832, R parameters", &siemens_rules},
    {"linuxcnc", "LinuxCNC: RS274/NGC with O-words and named parameters", &linuxcnc_rules},
    {"heidenhain-iso", "Heidenhain DIN/ISO: blocks ending in *, Q parameters", &heidenhain_iso_rules},
    {"klartext", "Heidenhain Klartext (.h): L, CC, C, CYCL DEF, Q parameters, PLANE", &klartext_rules},
}};

}  // namespace

std::span<const Dialect> dialects() { return table; }

const Dialect* find_dialect(std::string_view name) {
    const auto* found = std::find_if(table.begin(), table.end(), [&](const Dialect& d) { return d.name == name; });
    return found == table.end() ? nullptr : found;
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
