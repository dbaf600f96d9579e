#pragma once
// A cut across the formed surface, in numbers.

#include <string>

#include "core/diagnostic.h"
#include "core/geometry.h"
#include "machined/roughness.h"

namespace clsurf::io {

struct ProfileReport {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< [mm]
    double measured = 0;                          ///< [mm] of it on which something was cut
    Roughness roughness;
};

[[nodiscard]] std::string profile_text(const ProfileReport& p);
/// Keys: from_mm[2], to_mm[2], measured_mm, ra_um, rz_um, cutoff_mm, sampling_lengths, evaluated_mm, diagnostics[].
[[nodiscard]] std::string profile_json(const ProfileReport& p, const Diagnostics& diagnostics);

}  // namespace clsurf::io
