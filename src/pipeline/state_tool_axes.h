#pragma once
// The tool axes of a path without kinematics, from the tilted planes of its program.

#include "mapping/line_map.h"

namespace clsurf {

/// Gives `path`, which has no kinematics, the axes that `program` states, by the motion of each point; points without a
/// motion keep the axis of the point before. `program` is in the coordinates of the path. Warning `path.tool-axis` where the
/// program turns the tool and does not state where it points, unless rotary axes of the log have been noted already:
/// then the axis is not known. No effect with kinematics. O(motions), and O(points) where the program tilts the tool.
void state_tool_axes(Trajectory& path, const Program& program, const LineMap& lines, Diagnostics& diagnostics);

/// That warning alone.
void note_unknown_axis(const Program& program, Diagnostics& diagnostics);

}  // namespace clsurf
