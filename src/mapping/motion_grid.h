#pragma once
// MotionGrid: the motions of a program near a place. Built only if an alignment is lost.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/cell_grid.h"
#include "toolpath/toolpath.h"

namespace clsurf {

class MotionGrid {
public:
    /// Cells of about the motions' mean length. O(length / cell). `path` must outlive it.
    explicit MotionGrid(const Toolpath& path);

    /// Motions that come within `distance` [mm] of p, in order. If `distance` exceeds a cell, some may be missed.
    [[nodiscard]] std::vector<std::int64_t> near(const Vec3& p, double distance) const;

private:
    const Toolpath& path_;
    CellGrid grid_;
    std::unordered_map<CellGrid::Key, std::vector<std::uint32_t>> cells_;
};

}  // namespace clsurf
