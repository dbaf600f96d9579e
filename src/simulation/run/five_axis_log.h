#pragma once
// FiveAxisLog: makes records from the set points of five axes: servo loops, limits measured by differences, travel.

#include <array>
#include <functional>
#include <vector>

#include "simulation/path/five_axis_blocks.h"
#include "simulation/run/five_axis_point.h"
#include "simulation/run/path_limits.h"
#include "simulation/run/servo.h"

namespace clsurf {

/// Receives an exceeded limit: the axis, the value of its derivative, the limit, and the order of the derivative, 1 … 3.
using LimitExcess = std::function<void(std::size_t axis, double value, double limit, int order)>;

class FiveAxisLog {
public:
    /// All references must outlive the object.
    FiveAxisLog(const Program& program, const Machine& machine, const std::array<AxisLimits, 5>& limits,
                const FiveAxisSink& sink)
        : program_(&program),
          machine_(&machine),
          limits_(&limits),
          sink_(&sink),
          period_(machine.controller.period),
          normal_(period_) {}

    /// Adds the set point of the next period and computes its feedback.
    void add(FiveAxisPoint point, const LimitExcess& exceeds = {});
    void note_orientation(double error) { summary_.orientation_error = std::max(summary_.orientation_error, error); }
    void note_deviation(double error) { summary_.run.path_deviation = std::max(summary_.run.path_deviation, error); }
    [[nodiscard]] PointIndex points() const { return points_; }
    [[nodiscard]] FiveAxisSummary finish();

private:
    void measure(const FiveAxisPoint& point, const LimitExcess& exceeds);
    [[nodiscard]] Vec3 tip_of(const FiveAxisPoint& point) const;
    void measure_path(const FiveAxisPoint& point);
    void note_travel(std::size_t axis, double position, LineNumber line);
    void flush();

    const Program* program_;
    const Machine* machine_;
    const std::array<AxisLimits, 5>* limits_;
    const FiveAxisSink* sink_;
    double period_;
    std::vector<ServoLoop> servos_;
    std::array<std::array<double, 5>, 3> last_{};
    Vec3 last_tip_ = Vec3::Zero();
    double last_speed_ = 0, last_change_ = 0;  ///< speed of the tip [mm/s], and its change in a period
    NormalAcceleration normal_;
    std::array<bool, 5> outside_{};
    bool held_ = true;
    PointIndex points_ = 0;
    std::vector<FiveAxisPoint> block_of_points_;
    FiveAxisSummary summary_;
};

}  // namespace clsurf
