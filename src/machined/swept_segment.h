#pragma once
// SweptSegment: a tool that moves straight from one position to another, and the height map that it leaves:
// over every cell the lowest point of all its outlines along the motion, not only of those at the two ends.

#include "machined/tool.h"

namespace clsurf {

/// Lengths in mm from the centre of the map's first cell; heights from any level.
struct SweptSegment {
    float x = 0, y = 0, z = 0;              ///< the tip where it begins
    float dx = 1, dy = 0;                   ///< unit vector in the plane
    float length = 0;                       ///< in the plane
    float slope = 0;                        ///< rise per length
    float along_low = 0, along_high = 0;    ///< cells that are looked at: from x, y along the way …
    float across_low = 0, across_high = 0;  ///< … and to the left of it
};

/// A map's cells, row by row; row r lies at y = r cell, column c at x = c cell.
struct CellBlock {
    float* z = nullptr;
    int columns = 0, rows = 0;
    float cell = 0;  ///< [mm]
};

/// Lowers the cells to what the segment leaves. Heights are exact but for float: 10^-7 of the tool's radius
/// and of the heights (a bull-nose tool: where the outline is lowest is interpolated, to 0.01 µm). The
/// outline's height is convex in the way, so that the lowest place on the infinite line, held back to
/// the segment's ends, is the lowest on the segment.
void lower(const CuttingTool& tool, const SweptSegment& segment, const CellBlock& cells);

}  // namespace clsurf
