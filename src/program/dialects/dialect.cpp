#include "program/dialects/dialect.h"

#include <algorithm>
#include <array>

namespace clsurf {
namespace {

constexpr std::array<Dialect, 4> table{{
    {DialectId::fanuc, "fanuc", "Fanuc, HNC and most others: G-code with custom macro B"},
    {DialectId::siemens, "siemens", "SINUMERIK: X=AC(…), TRAORI, CYCLE832, R parameters"},
    {DialectId::linuxcnc, "linuxcnc", "LinuxCNC: RS274/NGC with O-words and named parameters"},
    {DialectId::heidenhain_iso, "heidenhain-iso", "Heidenhain DIN/ISO: blocks ending in *, Q parameters"},
}};

}  // namespace

std::span<const Dialect> dialects() { return table; }

const Dialect* find_dialect(std::string_view name) {
    const auto* found = std::find_if(table.begin(), table.end(), [&](const Dialect& d) { return d.name == name; });
    return found == table.end() ? nullptr : found;
}

}  // namespace clsurf
