#pragma once
// End points: near the ends of passes, lines of the same lengths on every pass. There the tool brakes before a turn and speeds
// up after it. How fast it does so depends on where its lines end.

#include <cstdint>
#include <vector>

#include "program/program.h"
#include "repair/points/aligned_points.h"
#include "repair/points/line_rules.h"
#include "surface/programmed_surface.h"

namespace clsurf {

/// Replaces the aligned points near the ends of a pass by fixed ones at the distances of `ends`. The section is `length`
/// [mm] long. `from_begin`, `to_end`: whether it begins or ends where its pass does. O(points).
void fix_end_points(std::vector<AlignedPoint>& aligned_points, double length, bool from_begin, bool to_end,
                    const EndLines& ends);

/// The pass up to the corners where it turns. The points of a pass begin and end near these, often inside a line: lines that
/// continue the pass for less than a step-over belong to it.
[[nodiscard]] ProgrammedPass up_to_corners(const ProgrammedSurface& programmed, ProgrammedPass pass);

/// Marks the motions of all cut passes within `reach` [mm] of an end, one entry per motion. O(points).
void mark_pass_ends(const Program& program, const ProgrammedSurface& programmed, double reach,
                    std::vector<std::uint8_t>& marks);

}  // namespace clsurf
