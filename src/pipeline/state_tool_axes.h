#pragma once
// The tool axes of a path without kinematics, from the tilted planes of its program.

#include "mapping/line_map.h"

namespace clsurf {

/// Gives `path`, which has no kinematics, the axes that `program` states, by the motion of each point; points without a
/// motion keep the axis of the previous point. `program` is in the coordinates of the path. The axis is unknown if the
/// program turns the tool without stating its direction: then adds a warning `path.tool-axis`, unless rotary axes of the
/// log have been noted already. No effect with kinematics. O(motions), and O(points) if the program tilts the tool.
void state_tool_axes(Trajectory& path, const Program& program, const LineMap& lines, Diagnostics& diagnostics);

/// Adds only that warning.
void note_unknown_axis(const Program& program, Diagnostics& diagnostics);

}  // namespace clsurf
