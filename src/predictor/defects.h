#pragma once
// Defects: places where a pass differs from its neighbours enough to leave a mark, each with its cause, depth and the program
// lines on both sides.
//
// Passes are compared at sites (sites.h): places every few milliseconds that are fixed in the workpiece. A site is a candidate
// if its residual exceeds half the threshold. It starts a defect if residual and step both exceed the threshold. Candidates are
// joined along their pass, to the adjacent pass and across one clean pass (the lag of a zigzag shows on every second pass).
// Groups without a start are dropped. Each remaining group is reduced, on each pass, to the sites where its main quantity is at
// least half of its peak there. Motion (speed and acceleration) and heights are grouped separately, so that a lag all over the
// part does not hide a slow pass. A height where the motion differs belongs to the defect of the motion. A lag that alternates
// with the direction of travel over a large part of the surface is one defect (systematic_lag.h). Defects with the highest
// score, in multiples of the threshold, come first.

#include "mapping/line_map.h"
#include "predictor/defect.h"

namespace clsurf {

/// All defects of a surface. `lines` maps them to program lines; `program` is needed to detect corners and point spacing.
/// O(points + candidates log candidates), parallel; the same for any number of threads.
[[nodiscard]] QualityReport find_defects(const ClSurface& surface, const Signals& signals, const LineMap& lines,
                                         const Program& program, double period, const QualityRules& rules);

}  // namespace clsurf
