#pragma once
// LogUnit: whether the positions of a log are in a unit other than the stated one.

#include <optional>
#include <string>

#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// A unit that makes the positions as large as the path of the program.
struct LogUnit {
    std::string name;      ///< "inch"
    std::string evidence;  ///< a clause: the extents of both
};

/// nullopt unless the path extends over 1/25.4, 1/1000 or 1000 of the program's path on both of its longer axes, within a
/// tenth. O(points + motions), parallel.
[[nodiscard]] std::optional<LogUnit> other_unit(const Trajectory& path, const Program& program);

}  // namespace clsurf
