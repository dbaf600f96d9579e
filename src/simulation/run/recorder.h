#pragma once
// Recorder: receives the commanded position of each period, runs the servo loops, measures both, and passes the points on
// in blocks.

#include <algorithm>
#include <array>
#include <vector>

#include "machine/machine.h"
#include "simulation/run/path_limits.h"
#include "simulation/run/servo.h"
#include "simulation/run/simulated_point.h"

namespace clsurf {

class Recorder {
public:
    /// All references must outlive the object.
    Recorder(const Program& program, const Machine& machine, const Vec3& start, const PointSink& sink);

    /// Adds the position at the end of the next period [mm], its path speed [mm/s], and its deviation from the path by
    /// rounding [mm].
    void add(const Vec3& position, double speed, LineNumber line, LimitingFactor limiting, double deviation) {
        block_.push_back({position, Vec3::Zero(), speed, line, limiting});
        summary_.path_deviation = std::max(summary_.path_deviation, deviation);
        ++summary_.points;
        if (block_.size() == points_at_once) flush();
    }
    [[nodiscard]] PointIndex points() const { return summary_.points; }
    /// Passes the remaining points to the sink and returns the summary.
    SimulationSummary finish();

private:
    static constexpr std::size_t points_at_once = 1024;  ///< a number of points that fits into the cache of a core

    void flush();
    void follow();
    void measure();
    void watch_travel(const Vec3& position, LineNumber line);
    void judge_limits();

    const Program* program_;
    const Machine* machine_;
    const PointSink* sink_;
    double rate_;  ///< periods per second
    std::array<ServoLoop, 3> servos_;
    std::vector<SimulatedPoint> block_;
    Vec3 last_, last_step_ = Vec3::Zero(), last_bend_ = Vec3::Zero();  ///< position and its differences
    // Path speed and its change in a period [mm/s]; the greatest change, and the greatest difference of two changes.
    double last_speed_ = 0, last_change_ = 0, speed_change_ = 0, second_change_ = 0;
    double greatest_step_ = 0;                                               ///< squared [mm²]
    Vec3 step_ = Vec3::Zero(), bend_ = Vec3::Zero(), twist_ = Vec3::Zero();  ///< greatest differences [mm]
    NormalAcceleration normal_;
    std::array<bool, 3> outside_{};
    SimulationSummary summary_;
};

}  // namespace clsurf
