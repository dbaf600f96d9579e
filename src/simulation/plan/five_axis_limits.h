#pragma once
// The limits of a five-axis machine at a place of a FiveAxisPath, as limits of the speed, acceleration and jerk of the path
// parameter u.

#include <vector>

#include "core/not_finite.h"
#include "machine/machine.h"
#include "simulation/path/five_axis_path.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {

/// The limits at a place.
struct LimitPlace {
    double u = 0;
    double free_cap = infinite, cap = infinite;  ///< limits of u's speed: without bends; with them, for first speeds
    double acceleration = 0, jerk = 0;           ///< of u, as on a straight path with the same slopes
    double square = 0;                           ///< first value of v²
    LimitingFactor why = LimitingFactor::none;
};

class FiveAxisLimits {
public:
    /// Both arguments must outlive the object.
    FiveAxisLimits(const FiveAxisPath& path, const Machine& machine);

    /// The limits at a place of the path; `d`: output, the derivatives there.
    [[nodiscard]] LimitPlace at(double u) const;
    LimitPlace at(double u, AxisSample<5>& d) const;
    /// The limits at all places of the path, in order.
    [[nodiscard]] std::vector<LimitPlace> at_places() const;
    /// Whether a speed, acceleration and jerk of u stay within all limits at a place. `side` −1: u is counted backward.
    [[nodiscard]] bool hold(double u, int side, double speed, double acceleration, double jerk) const;

    [[nodiscard]] const ProblemLimits<5>& of_axes() const { return limits_; }
    /// Shortest time in which the jerk limit permits an acceleration to reach its limit [s].
    [[nodiscard]] double ramp() const { return ramp_; }

private:
    const FiveAxisPath* path_;
    const Machine* machine_;
    ProblemLimits<5> limits_;
    FiveAxes speeds_;
    double ramp_ = infinite;
};

}  // namespace clsurf
