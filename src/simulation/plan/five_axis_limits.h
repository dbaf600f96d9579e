#pragma once
// What the limits of a machine with five axes say at a place of a FiveAxisPath: speeds, and the acceleration and jerk of its
// parameter.

#include <vector>

#include "core/not_finite.h"
#include "machine/machine.h"
#include "simulation/path/five_axis_path.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {

/// What the limits say at a place.
struct LimitPlace {
    double u = 0;
    double free_cap = infinite, cap = infinite;  ///< of u's speed: without bends, and for first speeds with them
    double acceleration = 0, jerk = 0;           ///< of u, on a straight path with these slopes
    double square = 0;                           ///< v² to begin with
    LimitingFactor why = LimitingFactor::none;
};

class FiveAxisLimits {
public:
    /// Both must outlive it.
    FiveAxisLimits(const FiveAxisPath& path, const Machine& machine);

    /// At a place of the path; `d`: the derivatives there.
    [[nodiscard]] LimitPlace at(double u) const;
    LimitPlace at(double u, AxisSample<5>& d) const;
    /// At all places of the path, in order.
    [[nodiscard]] std::vector<LimitPlace> at_places() const;
    /// Whether a speed, acceleration and jerk of u hold all limits at a place. `side` -1: u is counted backwards.
    [[nodiscard]] bool hold(double u, int side, double speed, double acceleration, double jerk) const;

    [[nodiscard]] const ProblemLimits<5>& of_axes() const { return limits_; }
    /// Least time in which a jerk reaches an acceleration [s].
    [[nodiscard]] double ramp() const { return ramp_; }

private:
    const FiveAxisPath* path_;
    const Machine* machine_;
    ProblemLimits<5> limits_;
    FiveAxes speeds_;
    double ramp_ = infinite;
};

}  // namespace clsurf
