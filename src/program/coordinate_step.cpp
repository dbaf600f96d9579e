#include "program/coordinate_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/units.h"
#include "program/frame_placement.h"

namespace clsurf {
namespace {

constexpr std::int64_t sample_size = 10'000;
constexpr int most_decimals = 6;
constexpr double whole = 1e-3;  ///< rounding error of a multiple, as a share of a step
constexpr double most_others =
    0.1;  ///< share of the coordinates that need not be multiples: ends of arcs and computed values

/// Counts for one axis how many coordinates are multiples of 10⁻ᵈ units.
class Multiples {
public:
    explicit Multiples(double unit) : unit_(unit) {}

    void add(double coordinate) {
        double step = unit_;
        for (std::int64_t& count : by_decimals_) {
            step *= 0.1;
            const double steps = coordinate / step;
            if (std::abs(steps - std::round(steps)) <= whole) ++count;
        }
        ++all_;
    }
    /// [mm]; 0: none
    [[nodiscard]] double step() const {
        double step = unit_;
        for (const std::int64_t count : by_decimals_) {
            step *= 0.1;
            if (static_cast<double>(count) >= (1 - most_others) * static_cast<double>(all_)) return step;
        }
        return 0;
    }
    [[nodiscard]] bool any() const { return all_ > 0; }

private:
    double unit_;  ///< [mm]
    std::array<std::int64_t, most_decimals> by_decimals_{};
    std::int64_t all_ = 0;
};

}  // namespace

double coordinate_step(const Motions& motions) {
    struct Axis {
        Multiples millimetres{1}, inches{mm_per_inch};
    };
    std::array<Axis, 3> axes;
    const std::int64_t stride = std::max<std::int64_t>(motions.size() / sample_size, 1);
    for (std::int64_t i = 0; i < motions.size(); i += stride) {
        const auto at = static_cast<std::size_t>(i);
        if (!is_cut(motions.kind[at])) continue;
        const WorkFrame& frame = motions.frame_of(i);
        const Vec3 end = frame.words.to_programmed(apply(frame.placed.inverse(), motions.end[at].vec()));
        for (std::size_t axis = 0; axis < axes.size(); ++axis) {
            const double coordinate = end[static_cast<int>(axis)];
            if (!std::isfinite(coordinate)) continue;
            axes[axis].millimetres.add(coordinate);
            axes[axis].inches.add(coordinate);
        }
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Axis& axis : axes) {
        if (axis.millimetres.any()) least = std::min(least, std::max(axis.millimetres.step(), axis.inches.step()));
    }
    return std::isfinite(least) ? least : 0;
}

}  // namespace clsurf
