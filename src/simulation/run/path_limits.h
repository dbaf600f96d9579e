#pragma once
// Whether a simulated run holds the limits of the path: the one that it exceeds most.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "machine/machine.h"
#include "simulation/run/simulated_point.h"

namespace clsurf {

/// The greatest acceleration across the path that differences of its positions prove.
///
/// The second difference is a mean of the acceleration over two periods, taken here across the chord of both steps. Where the
/// direction turns by θ within it, it is θ/2 off that chord, and what acts along the path has a share sin(θ/2) across it. That
/// share of the tangential acceleration, the greatest in these periods and one to either side, is subtracted: a tip that nearly
/// reverses within a period brakes and accelerates in the same direction.
class NormalAcceleration {
public:
    /// `period` [s]
    explicit NormalAcceleration(double period) : rate_(1 / period) {}

    /// The step of the next period [mm], and the path speed at its end [mm/s]. It is judged a period later: after the last one
    /// there is one at rest.
    void add(const Vec3& step, double speed) {
        // A step that is longer or shorter than both speeds say was faster or slower in between: 4/T of that is least.
        const double between = step.norm() * rate_ - 0.5 * (speed_ + speed);
        changes_ = {changes_[1], changes_[2], changes_[3], std::max(std::abs(speed - speed_), 4 * std::abs(between))};
        if ((out_ - in_).squaredNorm() > least_bend_) measure();
        in_ = out_;
        out_ = step;
        speed_ = speed;
    }
    [[nodiscard]] double greatest() const { return greatest_; }  ///< [mm/s²]

private:
    void measure();

    double rate_;
    double speed_ = 0;
    Vec3 in_ = Vec3::Zero(), out_ = Vec3::Zero();  ///< the steps before the last one
    std::array<double, 4> changes_{};              ///< of the speed in a period, at least [mm/s]
    double greatest_ = 0, least_bend_ = 0;         ///< squared: less has no greater part across [mm²]
};

/// A limit that is exceeded.
struct LimitExcessOfPath {
    double factor = limit_tolerance;  ///< of the limit
    std::string what;                 ///< "normal acceleration of the path"; empty: all hold
};

/// The limit of the path that a run exceeds most. Not judged are limits that a planner does not hold: the tangential jerk with
/// the trapezoidal planner and with arcs in corners, the normal acceleration with the trapezoidal planner, whose blocks
/// overlap, and where speeds step in corners (CornerMode::junction).
[[nodiscard]] LimitExcessOfPath excess_of_path(const SimulationSummary& summary, const Machine& machine);

}  // namespace clsurf
