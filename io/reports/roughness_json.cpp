#include "io/reports/roughness_json.h"

#include "core/units.h"

namespace clsurf::io {

Json roughness_json(const std::optional<PartRoughness>& roughness) {
    if (!roughness) return nullptr;
    const auto known = [](bool is, double mm) { return is ? number(mm * um_per_mm, 3) : Json(nullptr); };
    const bool form = !roughness->patches.empty(), machine = roughness->machine.cells > 0;
    return Json{{"ra_um", known(form, roughness->ra)},
                {"rz_um", known(form, roughness->rz)},
                {"sa_um", known(form, roughness->sa)},
                {"sq_um", known(form, roughness->sq)},
                {"machine_sa_um", known(machine, roughness->machine.sa)},
                {"machine_sq_um", known(machine, roughness->machine.sq)},
                {"form_unknown_percent", number(100 * roughness->unknown, 1)}};
}

}  // namespace clsurf::io
