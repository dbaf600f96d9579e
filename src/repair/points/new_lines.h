#pragma once
// New lines: the points of a smooth curve that become the ends of lines. Adjacent passes get their points next
// to each other, and no line leaves the curve or the programmed path by too much.

#include <vector>

#include "repair/points/smooth_segment.h"
#include "repair/points/turning_segment.h"

namespace clsurf {

/// The ends of the lines that replace a section, without its start; the last one is the end of the section. Lines end
/// at every first, second, fourth … aligned point, as the chord error permits; the aligned point number determines which.
/// Additional points are inserted where a line would be too far from old points or would turn the tool axis away.
/// `turning`: nullptr if the tool axis does not move. O(points).
[[nodiscard]] std::vector<NewPlace> new_lines(const OldSegment& old, const SmoothSegment& curve,
                                              const std::vector<AlignedPoint>& aligned_points, const LineRules& rules,
                                              const TurningSegment* turning);

}  // namespace clsurf
