#pragma once
// ArcSteps: the speed on the arc of a corner if axes have jerk limits.
//
// A line and an arc are tangent, but the curvature jumps where they meet, so the acceleration steps by v²/r. No speed
// satisfies a jerk limit there. A controller gives one position per period, and a drive spreads a step over its response
// time. Therefore the limit applies to the mean over a time t: no axis changes its acceleration by more than J t within t,
// which means v ≤ √(J r t) if the step is along one axis. With t = T the differences of set points also satisfy the limit:
// a step of J T gives a third difference of at most 3/4 J T³, the peak of the quadratic B-spline. The rest of the limit
// remains for changes of the speed.

#include "machine/machine.h"
#include "simulation/path/path_element.h"

namespace clsurf {

class ArcSteps {
public:
    // Shares of the axes' jerk limits that remain next to the 3/4 of a step (docs/simulate.md#speed-of-arcs):
    static constexpr double jerk_share = 0.15;  ///< for changes of the speed
    static constexpr double twist_share = 0.1;  ///< for a block that is itself curved

    explicit ArcSteps(const Machine& machine);

    /// Whether an axis has a jerk limit.
    [[nodiscard]] bool count() const { return time_ > 0; }
    /// The speed for a change of the curvature at one place [1/mm] [mm/s].
    [[nodiscard]] double speed(const Vec3& change) const;
    /// The speed for both ends of an arc and for its turn within the time [mm/s]. `before`, `after`: adjacent curvature
    /// [1/mm].
    [[nodiscard]] double speed(const PathElement& arc, const Vec3& before, const Vec3& after) const;
    /// The distance to each side of a step within which differences of set points contain it, at a speed [mm].
    [[nodiscard]] double reach(double speed) const { return speed * (period_ + 0.5 * time_); }

private:
    double time_ = 0;  ///< [s]
    double period_;    ///< [s]
    Vec3 jerk_;        ///< [mm/s³]; infinite: not limited
};

}  // namespace clsurf
