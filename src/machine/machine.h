#pragma once
// Machine: the limits that the simulated controller keeps, and the dynamics of the drives. A value with the defaults
// of `clsurf machine --defaults`; io/readers/machine_file.h reads it from TOML.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.h"
#include "machine/fidelity.h"
#include "machine/kinematics.h"
#include "machine/uncertainty.h"

namespace clsurf {

/// Position loop of one axis around a velocity loop: of first order, or with a PI controller.
struct ServoModel {
    double position_gain = 100;             ///< Kv [1/s]
    double velocity_feedforward = 0.96;     ///< 1: no lag at constant speed
    double velocity_time_constant = 0.002;  ///< [s]; 0: the velocity loop is ideal
    double velocity_integral_time =
        0;                    ///< integral time of the velocity loop's PI controller [s]; 0: no integral action
    double dead_time = 0;     ///< from the command to the loop [s]
    double quantum = 0.0001;  ///< encoder resolution [mm]; 0: none
    double noise = 0;         ///< rms [mm]
    double backlash = 0;      ///< lost motion between drive and table [mm]
    double friction = 0;      ///< Coulomb, as the resulting loss of speed in the velocity loop [mm/s]
};

/// A linear axis in mm; a rotary one in rad.
struct MachineAxis {
    double travel_low = -400, travel_high = 400;  ///< [mm], in the machine's coordinates
    double max_speed = 250;                       ///< [mm/s]
    double max_acceleration = 2000;               ///< [mm/s²]
    double max_jerk = 80000;                      ///< [mm/s³]; 0: not limited
    ServoModel servo;
};

enum class CornerMode : unsigned char {
    spline,    ///< rounded inside the tolerance by a curve of continuous curvature
    arc,       ///< rounded inside the tolerance by circular arcs; if an axis has a jerk limit, see arc_step_time
    stop,      ///< exact stop at every corner
    junction,  ///< not rounded: passed at the speed of JunctionSettings, with a step in axis speeds
};

/// The curve that replaces short lines.
enum class CurveMode : unsigned char {
    none,           ///< no curve: the lines are executed as they are
    akima,          ///< Akima's curve through their points
    least_squares,  ///< cubics fitted to the points of the lines
};

/// The name in a machine file.
[[nodiscard]] std::string_view name_of(CornerMode mode);
[[nodiscard]] std::string_view name_of(CurveMode mode);

/// How a controller plans speeds.
enum class PlannerKind : unsigned char {
    time_optimal,  ///< smoothed corners, with or without jerk limits, in minimum time: `corner` and `curve` describe it
    trapezoidal,   ///< block by block, constant accelerations, arcs and overlaps at corners, in periods (LinuxCNC)
};

[[nodiscard]] std::string_view name_of(PlannerKind kind);

/// Settings of the trapezoidal planner; the defaults are those of LinuxCNC 2.9.
struct TrapezoidSettings {
    bool arc_blends = true;           ///< corners become arcs if that is faster (ARC_BLEND_ENABLE)
    double gap_periods = 4;           ///< a shorter remainder of a line before an arc becomes part of the arc [periods]
    double ramp_frequency = 100;      ///< blocks shorter than its period have a single acceleration [Hz]
    double kink_ratio = 0.1;          ///< share of the acceleration that a change of direction between blocks may use
    double max_feed_override = 1;     ///< greatest feed override for which corners are planned
    int blocks_per_period = 1;        ///< blocks that reach the planner per period
    bool cubic_interpolation = true;  ///< set points are the knots of a cubic B-spline through three periods
    [[nodiscard]] bool operator==(const TrapezoidSettings&) const = default;
};

/// Rules for the speed at a corner that is passed without rounding; the lowest counts.
struct JunctionSettings {
    double deviation =
        0.01;  ///< distance of the corner from the arc that limits its speed by normal acceleration [mm]; 0: no rule
    double speed_step = 0;  ///< greatest step of an axis' speed [mm/s]; 0: no rule
    [[nodiscard]] bool operator==(const JunctionSettings&) const = default;
};

/// The highest speed of a motion.
enum class FeedRule : unsigned char {
    programmed,  ///< its feed
    intervals,  ///< its feed, or less if its constant-speed interval is planned to be slower (intervals/interval_feeds.h)
};

[[nodiscard]] std::string_view name_of(FeedRule rule);

struct ControllerSettings {
    PlannerKind planner = PlannerKind::time_optimal;
    FeedRule feed = FeedRule::programmed;
    TrapezoidSettings trapezoid;
    double period = 0.001;  ///< interpolation period [s]
    int lookahead_blocks = 500;
    double lookahead_distance = 0;  ///< known length after the current block [mm]; 0: not limited
    int replan_blocks = 0;          ///< blocks executed before speeds are planned again; 0: half of the known blocks
    CornerMode corner = CornerMode::arc;
    /// If an axis has a jerk limit: the time over which a step of its acceleration at the end of an arc is assumed to
    /// spread [s]; 0: splines replace arcs.
    double arc_step_time = 0;
    JunctionSettings junction;
    CurveMode curve = CurveMode::none;
    double tolerance = 0.01;  ///< of corners and path [mm]; G64 P replaces it
    /// Consecutive lines whose ends are within this distance of a common line are merged before corners are rounded
    /// [mm]; 0: none; nullopt: the planner's default: trapezoidal by the program (G64 Q), time_optimal never.
    std::optional<double> merging_tolerance;
    double chord_tolerance = 0.002;  ///< distance of the chord of one period from an arc [mm]
    double block_time = 0;           ///< the shortest duration of a block [s]: the controller's time to prepare one
    bool whole_periods = false;      ///< feeds are lowered so that a block at its feed takes a whole number of periods
    double feed_override = 1;        ///< of programmed feeds, not of rapids
    [[nodiscard]] bool operator==(const ControllerSettings&) const = default;
};

/// Whether the time-optimal planner rounds corners.
[[nodiscard]] constexpr bool rounds_corners(const ControllerSettings& controller) {
    return controller.corner == CornerMode::spline || controller.corner == CornerMode::arc;
}

struct PathLimits {
    double max_speed = 250;                 ///< [mm/s]
    double max_acceleration = 2000;         ///< tangential [mm/s²]
    double max_normal_acceleration = 1500;  ///< [mm/s²]
    double max_jerk = 50000;                ///< tangential [mm/s³]
    [[nodiscard]] bool operator==(const PathLimits&) const = default;
};

inline constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// Defaults of a rotary axis if a machine file does not give them: 20 turns a minute, an encoder resolution of 0.36
/// arc seconds. The axis that does not tilt turns without end stops.
[[nodiscard]] constexpr MachineAxis default_rotary(double travel_deg) {
    MachineAxis axis;
    axis.travel_low = -travel_deg * rad_per_deg;
    axis.travel_high = travel_deg * rad_per_deg;
    axis.max_speed = 120 * rad_per_deg;
    axis.max_acceleration = 600 * rad_per_deg;
    axis.max_jerk = 12000 * rad_per_deg;
    axis.servo.quantum = 0.0001 * rad_per_deg;
    return axis;
}

struct Machine {
    std::string name = "three-axis mill";
    ControllerSettings controller;
    PathLimits path;
    std::array<MachineAxis, 3> axes;  ///< x, y, z
    Kinematics kinematics;
    std::array<MachineAxis, 2> rotary{default_rotary(120), default_rotary(36000)};  ///< tilt, rotation
    std::optional<Fidelity> fidelity;                                               ///< measured on recorded runs
    std::vector<ParameterUncertainty> uncertainty;                                  ///< empty: not in the file

    /// The axis x, y, z, or a rotary axis by the letter of the kinematics; nullptr: the machine does not have it.
    [[nodiscard]] MachineAxis* axis(char letter);
};

}  // namespace clsurf
