#pragma once
// PathGrid: sparse points of the cutting passes by cell, to find a nearby part of the path. Used only where a
// search along the adjacent pass starts or is lost.

#include <cstdint>
#include <vector>

#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class PathGrid {
public:
    /// One entry per `cell` [mm] of arc length of every cut pass. O(points).
    PathGrid(const Positions& positions, const Passes& passes, const ArcLength& arc_length, double cell);

    struct Entry {
        PointIndex point = 0;
        std::int32_t pass = 0;  ///< index into passes
    };

    /// f(entry) for every entry in the 27 cells round a position.
    template <typename F>
    void for_each_near(const Eigen::Vector3f& p, F&& f) const {
        const Eigen::Vector3i c = cell_of(p);
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dz = -1; dz <= 1; ++dz) {
                    const std::uint64_t cell = key(c + Eigen::Vector3i(dx, dy, dz));
                    const std::size_t slot = cell * hash_factor >> shift_;
                    for (std::uint32_t k = slot_start_[slot]; k < slot_start_[slot + 1]; ++k) {
                        if (cells_[k] == cell) f(entries_[k]);
                    }
                }
            }
        }
    }

private:
    static constexpr std::uint64_t hash_factor = 0x9e3779b97f4a7c15ull;

    [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3f& p) const {
        return (p * per_mm_).array().floor().cast<int>();
    }
    static std::uint64_t key(const Eigen::Vector3i& c) {
        const auto part = [](int v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) & 0x1fffff; };
        return part(c.x()) << 42 | part(c.y()) << 21 | part(c.z());
    }

    float per_mm_ = 1;
    unsigned shift_ = 63;
    Column<std::uint32_t> slot_start_;
    Column<std::uint64_t> cells_;  ///< cell of each entry, entries sorted by slot
    Column<Entry> entries_;
};

}  // namespace clsurf
