#pragma once
// Surface data files: areal maps after ISO 25178-71, `.sdf`, versions 1.0 and 2.0 and their forerunner BCR-1.0, as text or
// binary.
//
// A header gives the grid (NumPoints columns, NumProfiles rows), its spacings and the scale of the heights in metres, and
// the type of the values. Text has lines "Xscale = 1e-6" up to a line "*", values up to another one, BAD where nothing was
// measured. Binary has fixed fields, little-endian; the lowest value of a signed or floating type stands where nothing was
// measured. Used inside io only.

#include "io/files/mapped_file.h"
#include "measured/measured_data.h"

namespace clsurf::io {

/// Whether a file begins as a surface data file does.
[[nodiscard]] bool is_surface_data(const Source& source);
/// Throws InputError with line or byte.
[[nodiscard]] MeasuredData read_surface_data(const Source& source);

}  // namespace clsurf::io
