#pragma once
// Jerk-limited speed profiles: ramps, and the seven-phase profile with unequal end speeds. The
// acceleration is zero at both ends of a profile. Lengths mm, speeds mm/s, accelerations mm/s²,
// jerks mm/s³; an infinite acceleration limit means none (the five-phase profile of Li et al. 2025).

#include <array>

namespace clsurf {

/// Duration of a ramp over a speed difference |v1 − v0| [s].
[[nodiscard]] double ramp_time(double difference, double acceleration, double jerk);
/// Arc length of a ramp from v0 to v1 [mm]. A ramp is point-symmetric, so this is mean speed times duration.
[[nodiscard]] double ramp_distance(double v0, double v1, double acceleration, double jerk);
/// The greatest speed that a ramp from v0 reaches over an arc length; by time reversal also the greatest speed from which
/// braking reaches v0. Closed form: T³ + (2 v0/j) T = L/j is solved with the hyperbolic sine, which has no cancellation for
/// large v0, unlike Cardano's formula.
[[nodiscard]] double reach(double v0, double arc_length, double acceleration, double jerk);

/// The limits along a profile.
struct RampLimits {
    double speed = 0;
    double acceleration = 0;
    double deceleration = 0;
    double jerk = 0;
};

struct MotionState {
    double arc_length = 0, speed = 0, acceleration = 0;
};

enum class ProfileStatus : unsigned char {
    ok,
    end_speed_lowered,  ///< the end speed cannot be reached: `end_speed` is the reachable one
    infeasible_decel,   ///< the path is too short to brake: only a lower start speed is feasible
};

/// Jerk +, 0, −, 0, −, 0, + over seven durations.
class SCurve {
public:
    SCurve() = default;
    /// From given durations; accelerations and speeds follow from start speed and jerk.
    SCurve(double start_speed, double jerk, const std::array<double, 7>& durations);

    [[nodiscard]] double duration() const { return ends_[6]; }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] double end_speed() const { return end_speed_; }
    [[nodiscard]] double peak_speed() const { return starts_[3].speed; }
    [[nodiscard]] double jerk() const { return jerk_; }
    [[nodiscard]] const std::array<double, 7>& durations() const { return durations_; }
    /// When phase 0 … 6 ends [s].
    [[nodiscard]] double end_of(int phase) const { return ends_[static_cast<std::size_t>(phase)]; }
    /// State at the beginning of phase 0 … 6.
    [[nodiscard]] const MotionState& start_of(int phase) const { return starts_[static_cast<std::size_t>(phase)]; }
    /// State after t in phase `phase`; t is counted from the start of the profile.
    [[nodiscard]] MotionState in_phase(int phase, double t) const;
    /// State at t; at and after the end exactly (length, end speed, 0).
    [[nodiscard]] MotionState at(double t) const;
    /// The time at which an arc length in 0 … length is reached [s]. Closed form without jerk, otherwise Halley's method in
    /// a bracket.
    [[nodiscard]] double time_at(double arc_length) const;

    /// Sets length and end speed to the exact values, without the rounding errors of the phases.
    void pin_end(double length, double end_speed);

private:
    std::array<double, 7> durations_{}, ends_{};
    std::array<MotionState, 7> starts_{};
    double jerk_ = 0, length_ = 0, end_speed_ = 0;
};

struct PlannedProfile {
    ProfileStatus status = ProfileStatus::ok;
    SCurve profile;                ///< empty when infeasible
    double needed_arc_length = 0;  ///< length of the ramp between start and end speed [mm]
    double allowed_start = 0;      ///< infeasible_decel: the greatest feasible start speed [mm/s]
};

/// The fastest profile over `arc_length` from start to end speed, neither of which exceeds limits.speed.
[[nodiscard]] PlannedProfile plan_scurve(double arc_length, double start_speed, double end_speed,
                                         const RampLimits& limits);

/// The shortest ramp from a state in motion (v0, a0) to (v1, 0): three phases of jerk.
struct RunningRamp {
    std::array<double, 3> durations{}, jerks{};
    [[nodiscard]] double time() const { return durations[0] + durations[1] + durations[2]; }
    double arc_length = 0;  ///< [mm]
};
[[nodiscard]] RunningRamp ramp_from_state(double v0, double a0, double v1, double acceleration, double jerk);

}  // namespace clsurf
