#pragma once
// Lines of a program as a short text.

#include <span>
#include <string>

#include "predictor/defects.h"

namespace clsurf::io {

/// The lines of runs, each once: overlapping ranges are one, in rising order: "12-13, 40", at most `shown` ranges
/// and then "and 3 more"; "-": none has a line.
[[nodiscard]] std::string line_ranges(std::span<const DefectRun> runs, std::size_t shown);

/// The same with the word before it: "line 16", "lines 12-13, 40"; "no known line": none has one.
[[nodiscard]] std::string named_line_ranges(std::span<const DefectRun> runs, std::size_t shown);

}  // namespace clsurf::io
