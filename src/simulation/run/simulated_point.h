#pragma once
// SimulatedPoint: the result of a controller simulation for each period, and the summary of all periods.

#include <array>
#include <functional>
#include <span>

#include "core/diagnostic.h"
#include "simulation/path/path_stream.h"

namespace clsurf {

/// A record of the log: the positions at the end of a period.
struct SimulatedPoint {
    Vec3 commanded = Vec3::Zero(), feedback = Vec3::Zero();  ///< [mm]
    double speed = 0;                                        ///< of the commanded path [mm/s]
    LineNumber line = 0;
    LimitingFactor limit = LimitingFactor::none;
};

// Random programs are tested with this tolerance (docs/experiments/simulation.md#random-programs).
inline constexpr double limit_tolerance = 1.001;  ///< a limit counts as kept within it, because values are differences

/// Measurements of a run, from differences of its points.
struct SimulationSummary {
    PointIndex points = 0;
    double duration = 0;                     ///< [s]
    double max_speed = 0;                    ///< of the path [mm/s]
    double max_tangential_acceleration = 0;  ///< change of the path speed in a period [mm/s²]
    double max_tangential_jerk = 0;          ///< change of that acceleration in a period [mm/s³]
    double max_normal_acceleration = 0;      ///< greatest that differences establish (path_limits.h) [mm/s²]
    Vec3 max_axis_speed = Vec3::Zero(), max_acceleration = Vec3::Zero(), max_jerk = Vec3::Zero();
    double path_deviation = 0;  ///< greatest deviation of a point from the path by rounding [mm]
    /// No limit of an axis or of the path (excess_of_path()) is exceeded by more than limit_tolerance. If corners are not
    /// rounded (CornerMode::junction), accelerations and jerks of axes are not checked.
    bool limits_ok = true;
    std::array<PointIndex, 10> limited_by{};  ///< number of points by LimitingFactor
    Diagnostics diagnostics;
};

using PointSink = std::function<void(std::span<const SimulatedPoint>)>;

}  // namespace clsurf
