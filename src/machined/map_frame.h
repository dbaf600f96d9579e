#pragma once
// MapFrame: the position of a height map in the plane.

#include <cstdint>
#include <functional>
#include <span>

#include "core/geometry.h"

namespace clsurf {

using Box2 = Eigen::AlignedBox2d;

/// The position of a height map in the plane. Rows have the direction `along`, any unit vector, so that a map of one row is a
/// profile in any direction.
struct MapFrame {
    Vec2 corner = Vec2::Zero();  ///< [mm] middle of the first cell
    Vec2 along = Vec2::UnitX();
    double cell = 0;  ///< [mm]
    std::int64_t columns = 0, rows = 0;
    double row_pitch = 0;  ///< [mm] from row to row; 0: the same as from cell to cell

    [[nodiscard]] Vec2 across() const { return {-along.y(), along.x()}; }
    [[nodiscard]] double pitch_of_rows() const { return row_pitch > 0 ? row_pitch : cell; }
    [[nodiscard]] Vec2 at(double column, double row) const {
        return corner + cell * column * along + pitch_of_rows() * row * across();
    }
    /// The box of cells [column, column + columns) × [row, row + rows).
    [[nodiscard]] Box2 bounds(std::int64_t column, std::int64_t row, std::int64_t wide, std::int64_t high) const;
};

/// The axis-parallel frame of a box.
[[nodiscard]] MapFrame frame_of(const Box2& box, double cell);

/// Transforms places into axes of a frame: along its rows, along its columns, and up from a level [mm].
struct FrameAxes {
    Vec2 corner, along;
    double level = 0;

    [[nodiscard]] Vec3 operator()(const Vec3& p) const {
        const Vec2 off = p.head<2>() - corner;
        return {along.dot(off), along.x() * off.y() - along.y() * off.x(), p.z() - level};
    }
};

/// Receives rows [first_row, first_row + z.size() / columns): heights [mm] above AsMachinedSurface::level(), row by row; NaN:
/// nothing was cut there.
using TakeRows = std::function<void(std::int64_t first_row, std::span<float> z)>;

}  // namespace clsurf
