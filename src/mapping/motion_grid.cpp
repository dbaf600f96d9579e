#include "mapping/motion_grid.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double finest_cell = 0.5;  ///< [mm]
constexpr double most_entries = 2e7;

double cell_for(const Toolpath& path) {
    double total = 0;
    for (std::int64_t m = 0; m < path.size(); ++m) total += path.length(m);
    return std::max(
        {finest_cell, total / std::max<double>(1.0, static_cast<double>(path.size())), total / most_entries});
}

}  // namespace

MotionGrid::MotionGrid(const Toolpath& path) : path_(path), grid_(cell_for(path)) {
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const double length = path.length(m);
        if (!(length > 0)) continue;
        // A point per half cell of arc length: a motion is in every cell that it passes, except for clipped corners,
        // which the search in neighbour cells covers.
        const auto steps = static_cast<int>(std::ceil(2 * length / grid_.side()));
        CellGrid::Key before = ~CellGrid::Key{0};
        for (int k = 0; k <= steps; ++k) {
            const CellGrid::Key cell = grid_.key(path.at(m, static_cast<double>(k) / steps));
            if (cell != before) cells_[cell].push_back(static_cast<std::uint32_t>(m));
            before = cell;
        }
    }
}

std::vector<std::int64_t> MotionGrid::near(const Vec3& p, double distance) const {
    std::vector<std::int64_t> found;
    grid_.for_each_near(p, [&](CellGrid::Key key) {
        const auto cell = cells_.find(key);
        if (cell == cells_.end()) return;
        for (const std::uint32_t m : cell->second) {
            if (path_.projection(m, p).distance <= distance) found.push_back(m);
        }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace clsurf
