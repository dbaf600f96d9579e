#pragma once
// Lines of a program as a short text.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "predictor/defect.h"

namespace clsurf::io {

using LineRange = std::pair<LineNumber, LineNumber>;

/// The lines of the sections of a defect, with overlapping ranges merged. The range of the strongest section
/// (strongest_section()) is first, the others increase. Empty: no section has a line.
[[nodiscard]] std::vector<LineRange> sections_lines(const Defect& defect);

/// The same as text: "40, 12-13", at most `shown` ranges, then "and 3 more"; "-": no section has a line.
[[nodiscard]] std::string line_ranges(const Defect& defect, std::size_t shown);

/// The same with a noun: "line 16", "lines 40, 12-13"; "no known line": no section has a line.
[[nodiscard]] std::string named_line_ranges(const Defect& defect, std::size_t shown);

}  // namespace clsurf::io
