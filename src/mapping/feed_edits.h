#pragma once
// Feeds that were changed after the run: sections with a constant speed other than the programmed one.

#include "mapping/line_map.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Adds a warning `map.feed` for each section of one programmed feed (per minute) that mostly ran at another constant
/// speed, by more than 3 %, or faster than the feed. Sections of fewer than 200 points and five-axis motions are not
/// checked. A feed override looks the same, and a new feed that the machine did not reach shows no difference.
/// `period`: of the log [s]. O(points).
void note_changed_feeds(const Trajectory& path, double period, const Program& program, const LineMap& map,
                        Diagnostics& diagnostics);

}  // namespace clsurf
