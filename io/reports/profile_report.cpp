#include "io/reports/profile_report.h"

#include <fmt/format.h>

#include "core/units.h"
#include "io/files/json_value.h"

namespace clsurf::io {

std::string profile_text(const ProfileReport& p) {
    return fmt::format("Ra {:.2f} µm, Rz {:.2f} µm from X {:g} Y {:g} to X {:g} Y {:g} mm, {}, {:.3g} mm evaluated\n",
                       p.roughness.ra * um_per_mm, p.roughness.rz * um_per_mm, p.from.x(), p.from.y(), p.to.x(),
                       p.to.y(), cutoff_text(p.roughness.cutoff), p.roughness.length);
}

std::string profile_json(const ProfileReport& p, const Diagnostics& diagnostics) {
    return dump(Json{{"from_mm", Json::array({number(p.from.x()), number(p.from.y())})},
                     {"to_mm", Json::array({number(p.to.x()), number(p.to.y())})},
                     {"measured_mm", number(p.measured)},
                     {"ra_um", number(p.roughness.ra * um_per_mm)},
                     {"rz_um", number(p.roughness.rz * um_per_mm)},
                     {"cutoff_mm", number(p.roughness.cutoff)},
                     {"sampling_lengths", p.roughness.sampling_lengths},
                     {"evaluated_mm", number(p.roughness.length)},
                     {"diagnostics", list(diagnostics)}});
}

}  // namespace clsurf::io
