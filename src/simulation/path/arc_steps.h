#pragma once
// ArcSteps: how fast an arc in a corner may be passed where axes have jerk limits.
//
// A line and an arc are tangent, but the curvature jumps where they meet, so that the acceleration steps by v²/r. No jerk
// limit holds there at any speed. A controller gives one position a period, and a drive spreads a step over the time that
// it needs to follow. So the limit is held on the mean over a time t: no axis changes its acceleration by more than J t
// within t, which is v ≤ √(J r t) where the step is along one axis. With t = T the differences of set points hold the
// limit, too: a step of J T gives a third difference of at most 3/4 J T³, the peak of the quadratic B-spline. What that
// leaves is for changes of the speed.

#include "machine/machine.h"
#include "simulation/path/path_element.h"

namespace clsurf {

class ArcSteps {
public:
    // Of the axes' jerk limits next to a step, together what a step leaves of them:
    static constexpr double jerk_share = 0.15;  ///< for changes of the speed
    static constexpr double twist_share = 0.1;  ///< for a block that is bent itself

    explicit ArcSteps(const Machine& machine);

    /// Whether an axis has a jerk limit.
    [[nodiscard]] bool count() const { return time_ > 0; }
    /// For a change of the curvature at one place [1/mm] [mm/s].
    [[nodiscard]] double speed(const Vec3& change) const;
    /// For both ends of an arc, and what it turns within the time [mm/s]. `before`, `after`: curvature beside it [1/mm].
    [[nodiscard]] double speed(const PathElement& arc, const Vec3& before, const Vec3& after) const;
    /// To each side of a step, where differences of set points show it at a speed [mm].
    [[nodiscard]] double reach(double speed) const { return speed * (period_ + 0.5 * time_); }

private:
    double time_ = 0;  ///< [s]
    double period_;    ///< [s]
    Vec3 jerk_;        ///< [mm/s³]; infinite: not limited
};

}  // namespace clsurf
