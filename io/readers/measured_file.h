#pragma once
// A measurement of a finished part from a file: a profile or points as delimited text, or an areal map as a surface data
// file (ISO 25178-71).
//
// Text has one point per line; comments, separators and units are as in logs (formats/text_head.h). Column names,
// ignoring case: x, y, z; `height` for z. Without names, two columns are x and z, three are x, y and z. A unit follows
// the name, "z [µm]", or is in a line of its own below; the default is mm. Text may be Latin-1, and its lines may end with
// CR alone.

#include <string>
#include <vector>

#include "io/files/mapped_file.h"
#include "measured/measured_data.h"

namespace clsurf::io {

/// Columns by name or by number from 0: x and z, or x, y and z; empty: as above.
using MeasuredColumns = std::vector<std::string>;

/// Throws InputError with file and line: a missing column, a unit that is not a length, an invalid number, fewer than
/// three points, a surface data file that is truncated or compressed. Points without a height are left out and counted.
[[nodiscard]] MeasuredData read_measured(const std::string& path, const MeasuredColumns& columns = {});
[[nodiscard]] MeasuredData read_measured(const Source& source, const MeasuredColumns& columns = {});

}  // namespace clsurf::io
