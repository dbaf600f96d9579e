#pragma once
// Machine: the limits that the simulated controller keeps, and the dynamics of the drives. A value with the
// defaults of `clsurf machine --defaults`; io/readers/machine_file.h reads it from TOML.

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
    double velocity_integral_time = 0;      ///< of the velocity loop's PI controller [s]; 0: it does not integrate
    double dead_time = 0;                   ///< from the command to the loop [s]
    double quantum = 0.0001;                ///< encoder step [mm]; 0: none
    double noise = 0;                       ///< rms [mm]
    double backlash = 0;                    ///< play between drive and table [mm]
    double friction = 0;                    ///< Coulomb, as the speed that the velocity loop loses to it [mm/s]
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
    arc,       ///< rounded inside the tolerance by circular arcs; where an axis has a jerk limit as arc_step_time says
    stop,      ///< exact stop at every corner
    junction,  ///< not rounded: passed at the speed of JunctionSettings, so that axis speeds step
};

/// What takes the place of short lines.
enum class CurveMode : unsigned char {
    none,           ///< they are driven as lines
    akima,          ///< Akima's curve through their points
    least_squares,  ///< cubics beside their points
};

/// The word of a machine file.
[[nodiscard]] std::string_view name_of(CornerMode mode);
[[nodiscard]] std::string_view name_of(CurveMode mode);

/// How a controller plans speeds: the rules of its kind.
enum class PlannerKind : unsigned char {
    time_optimal,  ///< smoothed corners, limits of jerk or the fastest without: what `corner` and `curve` describe
    trapezoidal,   ///< block by block, constant accelerations, arcs and overlaps at corners, in periods (LinuxCNC)
};

[[nodiscard]] std::string_view name_of(PlannerKind kind);

/// Of the trapezoidal planner; the defaults are those of LinuxCNC 2.9.
struct TrapezoidSettings {
    bool arc_blends = true;           ///< corners become arcs where that is faster (ARC_BLEND_ENABLE)
    double gap_periods = 4;           ///< a shorter rest of a line before an arc joins the arc [periods]
    double ramp_frequency = 100;      ///< blocks shorter than its period run at one acceleration [Hz]
    double kink_ratio = 0.1;          ///< of the acceleration, that a step of direction between blocks may take
    double max_feed_override = 1;     ///< that corners are planned for
    int blocks_per_period = 1;        ///< that reach the planner in a period
    bool cubic_interpolation = true;  ///< set points are the joints of a cubic B-spline through three periods
    [[nodiscard]] bool operator==(const TrapezoidSettings&) const = default;
};

/// Rules for the speed at a corner that is passed without rounding; the lowest counts.
struct JunctionSettings {
    double deviation = 0.01;  ///< of the corner from the arc whose normal acceleration counts [mm]; 0: no rule
    double speed_step = 0;    ///< greatest step of an axis' speed [mm/s]; 0: no rule
    [[nodiscard]] bool operator==(const JunctionSettings&) const = default;
};

/// The highest speed of a motion.
enum class FeedRule : unsigned char {
    programmed,  ///< its feed
    intervals,  ///< its feed, or less where its constant-speed interval is planned to be slower (intervals/interval_feeds.h)
};

[[nodiscard]] std::string_view name_of(FeedRule rule);

struct ControllerSettings {
    PlannerKind planner = PlannerKind::time_optimal;
    FeedRule feed = FeedRule::programmed;
    TrapezoidSettings trapezoid;
    double period = 0.001;  ///< interpolation period [s]
    int lookahead_blocks = 500;
    double lookahead_distance = 0;  ///< known after the block that runs [mm]; 0: not limited
    int replan_blocks = 0;          ///< that run before speeds are planned again; 0: half of those known
    CornerMode corner = CornerMode::arc;
    /// Where an axis has a jerk limit: over which a step of its acceleration at the end of an arc counts as spread [s];
    /// 0: splines take the place of arcs.
    double arc_step_time = 0;
    JunctionSettings junction;
    CurveMode curve = CurveMode::none;
    double tolerance = 0.01;  ///< of corners and path [mm]; G64 P replaces it
    /// Lines whose ends lie within it of one line become that line before corners are rounded [mm]; 0: none do; nullopt:
    /// as the planner does, trapezoidal as the program says (G64 Q), time_optimal never.
    std::optional<double> merging_tolerance;
    double chord_tolerance = 0.002;  ///< of the steps of a period against arcs [mm]
    double block_time = 0;           ///< a block takes no less [s]: what the controller needs to prepare one
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

/// What a rotary axis is taken to do where a machine file does not say: 20 turns a minute, an encoder
/// step of 0.36 arc seconds. The axis that does not tilt turns on and on.
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
    std::vector<ParameterUncertainty> uncertainty;                                  ///< empty: the file says nothing
};

}  // namespace clsurf
