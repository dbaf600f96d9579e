#include "io/reports/roughness_words.h"

#include <fmt/format.h>

#include "core/units.h"

namespace clsurf::io {

void write_roughness_change(const RoughnessChange& change, const WriteChange& row) {
    const PartRoughness &before = change.before, &after = change.after;
    if (change.is_known()) {
        row("roughness Ra [µm]", before.ra * um_per_mm, after.ra * um_per_mm);
        row("roughness Rz [µm]", before.rz * um_per_mm, after.rz * um_per_mm);
        row("roughness Sa [µm]", before.sa * um_per_mm, after.sa * um_per_mm);
    }
    if (before.machine.cells > 0 && after.machine.cells > 0)
        row("  added by the machine, Sq [µm]", before.machine.sq * um_per_mm, after.machine.sq * um_per_mm);
}

std::string roughness_change_text(const RoughnessChange& change) {
    if (!change.is_known()) return {};
    const auto both = [](double before, double after) {
        return fmt::format("{:.2f} to {:.2f} µm", before * um_per_mm, after * um_per_mm);
    };
    return fmt::format("roughness Ra {}, Rz {}, Sa {}", both(change.before.ra, change.after.ra),
                       both(change.before.rz, change.after.rz), both(change.before.sa, change.after.sa));
}

}  // namespace clsurf::io
