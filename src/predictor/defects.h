#pragma once
// Defects: places where a pass differs from its neighbours enough to leave a mark, each with its
// cause, depth and the program lines on both sides.
//
// Judged are sites (sites.h), places every few milliseconds that stand fixed in the workpiece. A site is a candidate where its residual passes half
// the threshold, and it starts a defect where residual and step both pass it. Candidates are joined along
// their pass, across to the neighbour and over one clean pass (the lag of a zigzag shows on every
// second one); groups without a start are dropped. What is left is cut back on each pass to where its
// main quantity is at least half of its peak there. Motion (speed and acceleration) and heights are
// grouped apart, so that a lag all over the part does not hide a slow pass; a height that lies where
// the motion differs belongs to that. Lag that alternates with the direction of travel over a large part of the surface is one
// defect of the whole (systematic_lag.h). What stands farthest out, in multiples of its threshold, comes first.

#include "mapping/line_map.h"
#include "predictor/defect.h"

namespace clsurf {

/// All discontinuities between adjacent passes. `lines` names them; `program` tells corners and point
/// spacing. O(points + candidates log candidates), parallel; the same for any number of threads.
[[nodiscard]] QualityReport find_defects(const ClSurface& surface, const Signals& signals, const LineMap& lines,
                                         const Program& program, double period, const QualityRules& rules);

}  // namespace clsurf
