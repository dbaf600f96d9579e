#pragma once
// SweptPieces: a tool that moves straight from place to place, and the height map that it leaves: over every cell
// the lowest point of all its outlines along the motion, not only of those at the ends.
//
// A map is divided into quarters, again and again. Over a block of cells most pieces lie too high to lower any of it,
// and are left out there. That is exact: less the slope of the surface, the outline over a block is a convex function
// of the place and of the way along a piece, so that it lies above its tangent plane in the middle of both.

#include <vector>

#include "core/geometry.h"
#include "machined/outline_sweep.h"
#include "machined/tool.h"

namespace clsurf {

/// Straight pieces of the path of a tool's tip [mm]: from the middle of the map's first cell, heights from any level.
class SweptPieces {
public:
    [[nodiscard]] const std::vector<SweptPiece>& all() const { return pieces_; }
    void clear() { pieces_.clear(); }
    /// A straight motion, in pieces no longer than `longest` [mm]. Places that are not finite leave nothing.
    void add(const Vec3& from, const Vec3& to, double longest);

private:
    std::vector<SweptPiece> pieces_;
};

/// A map's cells, row by row; row r lies at y = r row_pitch, column c at x = c cell.
struct CellBlock {
    float* z = nullptr;
    int columns = 0, rows = 0;
    float cell = 0, row_pitch = 0;  ///< [mm]
};

/// The longest piece [mm] that lower() is exact and fast for, in maps of such cells.
[[nodiscard]] double longest_piece(const CuttingTool& tool, double cell);

/// Lowers the cells to what the tool leaves. Heights are exact but for float: 10^-7 of the tool's radius and of
/// the heights. O(pieces + cells · pieces that touch a block of 16 cells).
void lower(const CuttingTool& tool, const SweptPieces& pieces, const CellBlock& cells);

}  // namespace clsurf
