#pragma once
// A profile across the as-machined surface, in numbers.

#include <string>

#include "core/diagnostic.h"
#include "core/geometry.h"
#include "machined/roughness.h"

namespace clsurf::io {

struct ProfileReport {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< [mm]
    double measured = 0;                          ///< [mm] its length with a surface
    Roughness roughness;
};

[[nodiscard]] std::string profile_text(const ProfileReport& p);
/// Keys: from_mm[2], to_mm[2], measured_mm, ra_um, rz_um, cutoff_mm, sampling_lengths, evaluated_mm, diagnostics[].
[[nodiscard]] std::string profile_json(const ProfileReport& p, const Diagnostics& diagnostics);

}  // namespace clsurf::io
