#include "simulation/run/servo.h"

#include <cmath>

namespace clsurf {
namespace {

/// splitmix64 (Steele, Lea, Flood 2014): uniform in [0, 1).
double uniform(std::uint64_t& state) {
    state += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-53;
}

/// Sum of twelve uniform numbers minus six: mean 0, variance 1, bounded.
double noise_of_one(std::uint64_t& state) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform(state);
    return sum;
}

bool integrates(const ServoModel& model) {
    return model.velocity_integral_time > 0 && model.velocity_time_constant > 0;
}

}  // namespace

VelocityStep velocity_step_of(const ServoModel& model, double period) {
    if (!(model.velocity_time_constant > 0)) return {};
    if (!integrates(model)) {
        const double step = 1 - std::exp(-period / model.velocity_time_constant);
        return {.by_error = step, .by_integral = step};
    }
    // exp(A T) of (v − v_ref)′ = (w − (v − v_ref))/T_v, w′ = (v_ref − v)/T_n, from half the trace h of A and the root r of
    // its characteristic polynomial: e^{h T} (cosh(r T) + (A − h) sinh(r T)/r), where r may be imaginary.
    const double fast = 1 / model.velocity_time_constant, slow = 1 / model.velocity_integral_time;
    const double half = -fast / 2, squared = half * half - fast * slow;
    const double root = std::sqrt(std::abs(squared)), angle = root * period, decay = std::exp(half * period);
    const double even = decay * (squared < 0 ? std::cos(angle) : std::cosh(angle));
    double odd = decay * period;  // value for a double root
    if (angle > 0) odd *= (squared < 0 ? std::sin(angle) : std::sinh(angle)) / angle;
    return {.by_error = 1 - (even + (-fast - half) * odd),
            .by_integral = fast * odd,
            .integral_by_error = slow * odd,
            .integral_kept = even - half * odd};
}

ServoLoop::ServoLoop(const ServoModel& model, double period, double start, std::uint64_t seed)
    : gain_(model.position_gain),
      feedforward_(model.velocity_feedforward),
      quantum_(model.quantum),
      noise_(model.noise),
      period_(period),
      play_(0.5 * model.backlash),
      friction_(model.friction),
      step_(velocity_step_of(model, period)),
      integral_per_period_(integrates(model) ? period / model.velocity_integral_time : 0),
      commanded_(start),
      position_(start),
      table_(start),
      random_(seed) {
    if (!(model.dead_time > 0)) return;
    const double periods = model.dead_time / period;
    const double whole = std::floor(periods);
    late_share_ = periods - whole;
    delay_line_.assign(static_cast<std::size_t>(whole) + 2, start);
}

double ServoLoop::delayed(double commanded) {
    const std::size_t size = delay_line_.size();
    newest_ = (newest_ + 1) % size;
    delay_line_[newest_] = commanded;
    const std::size_t oldest = (newest_ + 1) % size;
    const std::size_t next = (newest_ + 2) % size;
    return (1 - late_share_) * delay_line_[next] + late_share_ * delay_line_[oldest];
}

/// Noise of a reading [mm].
double ServoLoop::noise() { return noise_ * noise_of_one(random_); }

}  // namespace clsurf
