#pragma once
// CellGrid: cubic cells of one size, each with a number. Everything near a place is in its own cell and the cells around
// it; a map from these numbers makes a sparse grid of anything.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/geometry.h"

namespace clsurf {

class CellGrid {
public:
    /// The number of a cell: its three indices, 21 bits each, x first. Sorting by number sorts by x, then y, then z.
    using Key = std::uint64_t;
    static constexpr int most_aside = 8;  ///< cells

    /// Cells of a side > 0 [mm].
    explicit CellGrid(double side) : side_(side) {}

    [[nodiscard]] double side() const { return side_; }
    /// The cell of a place [mm]. Each index is at most a million from that of the origin. Places that are farther
    /// away, or not finite, are in an outermost cell.
    [[nodiscard]] Key key(const Vec3& p) const {
        return index(p.x()) << (2 * bits) | index(p.y()) << bits | index(p.z());
    }

    /// key + step(x, y, z) is the key of the cell that is x, y and z cells away, at most most_aside each; unsigned
    /// numbers wrap.
    static constexpr Key step(int x, int y, int z) {
        return (static_cast<Key>(x) << (2 * bits)) + (static_cast<Key>(y) << bits) + static_cast<Key>(z);
    }
    /// Calls f(key) for a cell and those around it, `aside` ≤ most_aside to each side, sorted by key.
    template <typename F>
    static void for_each_near(Key cell, int aside, F&& f) {
        for (int x = -aside; x <= aside; ++x) {
            for (int y = -aside; y <= aside; ++y) {
                for (int z = -aside; z <= aside; ++z) f(cell + step(x, y, z));
            }
        }
    }
    /// The same for the 27 cells around a place.
    template <typename F>
    void for_each_near(const Vec3& p, F&& f) const {
        for_each_near(key(p), 1, f);
    }

private:
    static constexpr int bits = 21;
    static constexpr double middle = 1 << (bits - 1);
    static constexpr double lowest = most_aside, highest = 2 * middle - 1 - most_aside;

    [[nodiscard]] Key index(double x) const {
        const double cell = std::floor(x / side_) + middle;
        return static_cast<Key>(cell > lowest ? std::min(cell, highest) : lowest);  // NaN: the lowest
    }
    double side_;
};

}  // namespace clsurf
