#pragma once
// ServoLoop: the position of an axis for a given set point: a discrete position loop with velocity
// feed-forward around a velocity loop, the usual cascade of machine tools
// (doi:10.1007/s00170-021-07160-w).
//
//     v_ref = Kv (cmd − x) + c_ff · cmd′,    T_v v′ = v_ref − v + w,    T_n w′ = v_ref − v,    x′ = v
//
// w is what a PI controller of the velocity has integrated, 0 without an integral time T_n.
// At constant speed v the lag is v (1 − c_ff)/Kv. The loop compares position and command of the same record. A dead time
// delays the whole command; between records the command is linear. Coulomb friction subtracts f from v_ref in the direction
// of motion and keeps an axis at rest while |v_ref| ≤ f: the lag grows by f/Kv, and after a reversal the axis rests until
// the error is large enough. The loop uses the position of the drive. The encoder is on the table, which follows with the
// lost motion of the backlash. An integrating velocity loop compensates friction within about T_n: then friction shows at
// reversals only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "machine/machine.h"

namespace clsurf {

/// The response of the velocity loop to an error v_ref − v and to w in a period with constant v_ref (exact). The defaults are
/// those of an ideal loop.
struct VelocityStep {
    double by_error = 1, by_integral = 1;             ///< change of the speed
    double integral_by_error = 0, integral_kept = 1;  ///< w at the period's end
};
[[nodiscard]] VelocityStep velocity_step_of(const ServoModel& model, double period);

class ServoLoop {
public:
    /// `seed` gives each axis different noise, which is the same in every run.
    ServoLoop(const ServoModel& model, double period, double start, std::uint64_t seed);

    /// Takes the commanded position of the next period [mm], returns the encoder's position at its end [mm].
    double follow(double commanded) {
        if (!delay_line_.empty()) commanded = delayed(commanded);
        const double reference = gain_ * (commanded_ - position_) + feedforward_ * (commanded - commanded_) / period_;
        const double before = velocity_;
        velocity_ = driven(reference);
        // Friction stops an axis; it does not reverse it.
        if (friction_ > 0 && before * velocity_ < 0 && std::abs(reference + integral_) <= friction_) velocity_ = 0;
        position_ += velocity_ * period_;
        commanded_ = commanded;
        table_ = std::clamp(table_, position_ - play_, position_ + play_);
        const double read = noise_ > 0 ? table_ + noise() : table_;
        return quantum_ > 0 ? rounded(read / quantum_) * quantum_ : read;
    }

private:
    /// The speed after a period. w acts against the friction, whose direction is that at the start of the period.
    double driven(double reference) {
        const double push = reference + integral_;
        if (friction_ > 0 && velocity_ == 0 && std::abs(push) <= friction_) {
            integral_ += reference * integral_per_period_;
            return 0;
        }
        const double friction = std::copysign(friction_, velocity_ != 0 ? velocity_ : push);
        const double error = reference - velocity_, rest = integral_ - friction;
        integral_ = step_.integral_by_error * error + step_.integral_kept * rest + friction;
        return velocity_ + step_.by_error * error + step_.by_integral * rest;
    }
    /// std::round() without a call: truncates after adding almost 0.5.
    [[nodiscard]] static double rounded(double x) {
        constexpr double nearly_half = 0x1.fffffffffffffp-2;  // 0.5 would take the number before 0.5 to 1
        if (!(std::abs(x) < 0x1p52)) return x;
        return std::copysign(static_cast<double>(static_cast<std::int64_t>(x + std::copysign(nearly_half, x))), x);
    }
    [[nodiscard]] double noise();
    /// The command one dead time ago.
    double delayed(double commanded);

    double gain_, feedforward_, quantum_, noise_, period_, play_, friction_;
    VelocityStep step_;
    double integral_per_period_;  ///< T/T_n; 0: the velocity loop does not integrate
    double commanded_, position_, table_, velocity_ = 0;
    double integral_ = 0;  ///< w
    std::uint64_t random_;
    std::vector<double> delay_line_;  ///< the last commands, a ring; empty: no dead time
    std::size_t newest_ = 0;          ///< in the ring
    double late_share_ = 0;           ///< fractional part of the dead time [periods]
};

}  // namespace clsurf
