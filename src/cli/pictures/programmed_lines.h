#pragma once
// The path of a program as thin lines, shown with a log.

#include <string>
#include <vector>

#include "cli/options/part.h"

namespace clsurf::cli {

/// Why the path of the program cannot be shown with its log, as a clause: it came from standard input, or its machine has
/// rotary axes, whose programmed path is not that of the tool in the workpiece. Empty: it can be shown.
[[nodiscard]] std::string why_no_programmed_lines(const PartOptions& options, const Part& part);

/// Lines [mm] between rapids, in the coordinates of the workpiece, like the log. If there are more than `most_points` points,
/// some are left out evenly. Domain: why_no_programmed_lines() is empty. Reads the program. Throws InputError.
[[nodiscard]] std::vector<std::vector<Vec3>> programmed_lines(const PartOptions& options, PointIndex most_points);

}  // namespace clsurf::cli
