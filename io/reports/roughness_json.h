#pragma once
// Roughness as JSON.

#include <optional>

#include "io/files/json_value.h"
#include "machined/part_roughness.h"

namespace clsurf::io {

/// Heights [µm]: ra_um, rz_um, sa_um, sq_um, machine_sa_um, machine_sq_um, form_unknown_percent; null: not known.
[[nodiscard]] Json roughness_json(const std::optional<PartRoughness>& roughness);

}  // namespace clsurf::io
