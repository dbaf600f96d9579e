#pragma once
// The rule of a walk along a path, forward only: which projection of the next point is chosen, and how far ahead it is
// searched. Among projections that are equally near (back and forth on the same line), the one whose arc length fits the
// chord is chosen.

#include <algorithm>
#include <cmath>
#include <limits>

namespace clsurf {

/// One step of a walk, for a tool that moved by a chord. Lengths in mm; `Real` is the type of the path's positions.
template <typename Real>
class WalkWindow {
public:
    static constexpr Real lost_distance = Real(0.5);  ///< a walk that is farther off is lost

    explicit WalkWindow(Real chord) : chord_(chord) {}

    /// Whether a projection is the best so far. `distance`: from the point; `advance`: arc length from the beginning of the
    /// step.
    [[nodiscard]] bool is_better(Real distance, Real advance) {
        constexpr Real arc_length_penalty =
            Real(0.02);  // distance per length of difference between arc length and chord
        const Real cost = distance + arc_length_penalty * std::abs(advance - chord_);
        nearest_ = std::min(nearest_, distance);
        if (!(cost < best_cost_)) return false;
        best_cost_ = cost;
        return true;
    }

    /// Whether the tool cannot have gone this far. Projections farther than lost_distance do not count; without this bound,
    /// each point would search the whole path.
    [[nodiscard]] bool ends_before(Real arc_length) const {
        constexpr Real margin = Real(0.05);     // least arc length of the window
        constexpr Real of_chord = Real(2);      // per chord: corners are cut, the chord is shorter
        constexpr Real of_distance = Real(10);  // per distance: a projection jumps over a cut corner
        return arc_length > margin + of_chord * chord_ + of_distance * std::min(nearest_, lost_distance);
    }

private:
    Real chord_;
    Real best_cost_ = std::numeric_limits<Real>::infinity(), nearest_ = std::numeric_limits<Real>::infinity();
};

}  // namespace clsurf
