#pragma once
// Outline: the height that a tool leaves over a few cells when it moves along one straight piece of its path.

#include <array>
#include <cstddef>
#include <limits>

#include "machined/tool.h"

namespace clsurf {

/// The height over a cell that no tool has reached.
inline constexpr float not_reached = std::numeric_limits<float>::infinity();

/// A straight piece of the path of a tool tip [mm], described from its middle.
struct SweptPiece {
    float x, y, z;  ///< of the middle
    float dx, dy;   ///< unit vector in the plane
    float half;     ///< half of its length in the plane; 0: the tool rests or plunges
    float slope;    ///< rise per length
};

/// Cells near each other, in any order. They are padded to a multiple of `width` with cells that do not count.
struct CellGroup {
    // Eight floats fill a register of 32 bytes.
    static constexpr int most = 64, width = 8;

    alignas(32) std::array<float, most> x, y;   ///< [mm] positions
    alignas(32) std::array<float, most> plane;  ///< [mm] height of a plane at each …
    alignas(32) std::array<float, most> z;      ///< [mm] … and height of the part; −∞: does not count
    int size = 0;

    void add(float at_x, float at_y, float plane_there, float height) {
        const auto k = static_cast<std::size_t>(size++);
        x[k] = at_x;
        y[k] = at_y;
        plane[k] = plane_there;
        z[k] = height;
    }
    void fill_up() {
        while (size % width != 0) add(x[0], y[0], 0, -not_reached);
    }
};

/// The outline of a tool [mm].
class Outline {
public:
    explicit Outline(const CuttingTool& tool)
        : kind_(tool.kind),
          radius_(static_cast<float>(tool.radius)),
          corner_(static_cast<float>(tool.corner)),
          bottom_(static_cast<float>(tool.radius - tool.corner)) {}

    [[nodiscard]] float radius() const { return radius_; }
    [[nodiscard]] float corner() const { return corner_; }
    /// Radius of the flat bottom.
    [[nodiscard]] float bottom() const { return bottom_; }
    /// Height above the tip, `rho` from the axis.
    [[nodiscard]] float height(float rho) const;
    /// Lowers the cells to the height that the tool leaves along a piece. Returns the largest height of a cell above its plane
    /// after that.
    float lower(CellGroup& cells, const SweptPiece& piece) const;

private:
    ToolKind kind_;
    float radius_, corner_, bottom_;
};

}  // namespace clsurf
