#include "mapping/motion_grid.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double finest_cell = 0.5;  ///< [mm]
constexpr double most_entries = 2e7;

std::uint64_t key(const Eigen::Vector3i& c) {
    const auto part = [](int v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) & 0x1fffff; };
    return part(c.x()) << 42 | part(c.y()) << 21 | part(c.z());
}

}  // namespace

MotionGrid::MotionGrid(const Toolpath& path) : path_(path) {
    double total = 0;
    for (std::int64_t m = 0; m < path.size(); ++m) total += path.length(m);
    cell_ =
        std::max({finest_cell, total / std::max<double>(1.0, static_cast<double>(path.size())), total / most_entries});
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const double length = path.length(m);
        if (!(length > 0)) continue;
        // A point per half cell of arc length: a motion is in every cell that it passes, but for clipped
        // corners, which the search in neighbour cells makes good.
        const auto steps = static_cast<int>(std::ceil(2 * length / cell_));
        std::uint64_t before = ~std::uint64_t{0};
        for (int k = 0; k <= steps; ++k) {
            const std::uint64_t cell = key(cell_of(path.at(m, static_cast<double>(k) / steps)));
            if (cell != before) cells_[cell].push_back(static_cast<std::uint32_t>(m));
            before = cell;
        }
    }
}

std::vector<std::int64_t> MotionGrid::near(const Vec3& p, double distance) const {
    std::vector<std::int64_t> found;
    const Eigen::Vector3i centre = cell_of(p);
    for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dz = -1; dz <= 1; ++dz) {
                const auto cell = cells_.find(key(centre + Eigen::Vector3i(dx, dy, dz)));
                if (cell == cells_.end()) continue;
                for (const std::uint32_t m : cell->second) {
                    if (path_.projection(m, p).distance <= distance) found.push_back(m);
                }
            }
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace clsurf
