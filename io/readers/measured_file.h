#pragma once
// What was measured on a finished part, from a file: a profile or points as delimited text, an areal map as a surface data
// file (ISO 25178-71).
//
// Text has one place a line; comments, separators and units are those of logs (formats/text_head.h). Names of columns,
// whatever their case: x, y, z; `height` for z. Without names two columns are x and z, three x, y and z. A unit stands behind
// the name, "z [µm]", or in a line of its own below; without one it is mm. Text may be Latin-1, and its lines may end with
// CR alone.

#include <string>
#include <vector>

#include "io/files/mapped_file.h"
#include "measured/measured_data.h"

namespace clsurf::io {

/// Columns by name or number from 0: of x and z, or of x, y and z; empty: as above.
using MeasuredColumns = std::vector<std::string>;

/// Throws InputError with file and line: a column that is not there, a unit that is not a length, no number, fewer than
/// three places, a surface data file that is cut or compressed. A place without a height is left out, and counted.
[[nodiscard]] MeasuredData read_measured(const std::string& path, const MeasuredColumns& columns = {});
[[nodiscard]] MeasuredData read_measured(const Source& source, const MeasuredColumns& columns = {});

}  // namespace clsurf::io
