#pragma once
// Roughness in reports that compare two runs of a part.

#include <functional>
#include <string>
#include <string_view>

#include "pipeline/roughness_gauge.h"

namespace clsurf::io {

/// A name with its unit, before and after, in shown units.
using WriteChange = std::function<void(std::string_view, double, double)>;
/// The known rows of a table of both: Ra, Rz, Sa, and the contribution of the machine.
void write_roughness_change(const RoughnessChange& change, const WriteChange& row);

/// "roughness Ra 1.80 to 1.85 µm, Rz 7.10 to 7.20 µm, Sa 1.61 to 1.62 µm"; empty: not known.
[[nodiscard]] std::string roughness_change_text(const RoughnessChange& change);

}  // namespace clsurf::io
