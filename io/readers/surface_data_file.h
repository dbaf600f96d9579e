#pragma once
// Surface data files: areal maps and profiles as in ISO 25178-71, `.sdf`, versions 1.0 and 2.0, the predecessor BCR-1.0, and
// the variants NIST-1.0 and NPL-V1.0, as text or binary.
//
// A header has the grid (NumPoints columns, NumProfiles rows), its spacings and the scale of the heights in metres, and
// the type of the values. Text has lines "Xscale = 1e-6" up to a line "*", then values up to another "*"; BAD or NaN means
// not measured. Names ignore case, a comment follows a semicolon, and a comma is the decimal mark if a
// scale has one. Binary files have fixed fields, little-endian, or big-endian if only that gives a plausible spacing. A
// value is not measured if it is NaN, the lowest value of a signed or floating type, or the highest of an unsigned type of
// 16 or 32 bits. One row is a profile. Used inside io only.

#include "io/files/mapped_file.h"
#include "measured/measured_data.h"

namespace clsurf::io {

/// Whether a file begins like a surface data file.
[[nodiscard]] bool is_surface_data(const Source& source);
/// Throws InputError with line or byte.
[[nodiscard]] MeasuredData read_surface_data(const Source& source);

}  // namespace clsurf::io
