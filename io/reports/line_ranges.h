#pragma once
// Lines of a program as a short text.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "predictor/defect.h"

namespace clsurf::io {

using LineRange = std::pair<LineNumber, LineNumber>;

/// The lines of the sections of a defect, each once: overlapping ranges are one. The first is that of the strongest section
/// (strongest_section()), the others rise. Empty: no section has a line.
[[nodiscard]] std::vector<LineRange> sections_lines(const Defect& defect);

/// The same as text: "40, 12-13", at most `shown` ranges and then "and 3 more"; "-": none has a line.
[[nodiscard]] std::string line_ranges(const Defect& defect, std::size_t shown);

/// The same with the word before it: "line 16", "lines 40, 12-13"; "no known line": none has one.
[[nodiscard]] std::string named_line_ranges(const Defect& defect, std::size_t shown);

}  // namespace clsurf::io
