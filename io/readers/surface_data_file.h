#pragma once
// Surface data files: areal maps and profiles after ISO 25178-71, `.sdf`, versions 1.0 and 2.0, their forerunner BCR-1.0, and
// its relatives NIST-1.0 and NPL-V1.0, as text or binary.
//
// A header gives the grid (NumPoints columns, NumProfiles rows), its spacings and the scale of the heights in metres, and
// the type of the values. Text has lines "Xscale = 1e-6" up to a line "*", values up to another one, BAD or NaN where
// nothing was measured; names in any case, what follows a semicolon is a comment, and a comma is the decimal mark where a
// scale has one. Binary has fixed fields, little-endian, or big-endian where only that gives a spacing a part can have. The
// lowest value of a signed or floating type stands where nothing was measured, the highest of an unsigned one of 16 or 32
// bits, and NaN. One row is a profile. Used inside io only.

#include "io/files/mapped_file.h"
#include "measured/measured_data.h"

namespace clsurf::io {

/// Whether a file begins as a surface data file does.
[[nodiscard]] bool is_surface_data(const Source& source);
/// Throws InputError with line or byte.
[[nodiscard]] MeasuredData read_surface_data(const Source& source);

}  // namespace clsurf::io
