#pragma once
// SweptPieces: straight motions of a tool, and the height map that they leave: over every cell the lowest point of all outlines
// along the motions, not only of those at their ends.
//
// A map is divided into quarters recursively. Over a block of cells, most pieces are too high to lower any of it and are
// excluded there. This is exact: minus the slope of the surface, the outline over a block is a convex function of the position
// and of the distance along a piece, so it is above its tangent plane in the middle of both.

#include <vector>

#include "core/geometry.h"
#include "machined/outline_sweep.h"
#include "machined/tool.h"

namespace clsurf {

/// Straight pieces of the path of a tool tip [mm], relative to the middle of the map's first cell; heights from any level.
class SweptPieces {
public:
    [[nodiscard]] const std::vector<SweptPiece>& all() const { return pieces_; }
    void clear() { pieces_.clear(); }
    /// A straight motion, in pieces no longer than `longest` [mm]. Places that are not finite are ignored.
    void add(const Vec3& from, const Vec3& to, double longest);

private:
    std::vector<SweptPiece> pieces_;
};

/// The cells of a map, row by row: row r is at y = r row_pitch, column c at x = c cell.
struct CellBlock {
    float* z = nullptr;
    int columns = 0, rows = 0;
    float cell = 0, row_pitch = 0;  ///< [mm]
};

/// The longest piece [mm] for which lower() is exact and fast, in maps of such cells.
[[nodiscard]] double longest_piece(const CuttingTool& tool, double cell);

/// Lowers the cells to the heights that the tool leaves. Heights are exact to float precision: 10^-7 of the tool's radius and
/// of the heights. O(pieces + cells · pieces that touch a block of 16 cells).
void lower(const CuttingTool& tool, const SweptPieces& pieces, const CellBlock& cells);

}  // namespace clsurf
