#pragma once
// The limit of the path that a simulated run exceeds most.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "machine/machine.h"
#include "simulation/run/simulated_point.h"

namespace clsurf {

/// The greatest acceleration across the path that the differences of positions establish.
///
/// The second difference is a mean of the acceleration over two periods; its component across the chord of both steps is
/// used. If the direction turns by θ within the two periods, the path is up to θ/2 off that chord, and a tangential
/// acceleration has the share sin(θ/2) across it. That share is subtracted, with the greatest tangential acceleration in
/// these periods and one to either side: a tip that nearly reverses within a period brakes and accelerates in the same
/// direction.
class NormalAcceleration {
public:
    /// `period` [s]
    explicit NormalAcceleration(double period) : rate_(1 / period) {}

    /// Adds the step of the next period [mm] and the path speed at its end [mm/s]. It is evaluated one period later; after
    /// the last step the tip is at rest.
    void add(const Vec3& step, double speed) {
        // A step that does not match the speeds at its ends had a different speed in between: its least change is 4/T of
        // the difference.
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
    std::array<double, 4> changes_{};              ///< least possible changes of the speed in a period [mm/s]
    double greatest_ = 0, least_bend_ = 0;  ///< least_bend_: squared; a smaller bend has no greater part across [mm²]
};

/// An exceeded limit.
struct LimitExcessOfPath {
    double factor = limit_tolerance;  ///< value divided by the limit
    std::string what;                 ///< "normal acceleration of the path"; empty: no limit is exceeded
};

/// The limit of the path that a run exceeds most. Limits that a planner does not keep are not judged: the tangential jerk
/// with the trapezoidal planner and with arcs in corners; the normal acceleration with the trapezoidal planner, whose
/// blocks overlap, and with speed steps in corners (CornerMode::junction).
[[nodiscard]] LimitExcessOfPath excess_of_path(const SimulationSummary& summary, const Machine& machine);

}  // namespace clsurf
