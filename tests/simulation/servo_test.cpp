// ServoLoop compared with closed forms of a second-order loop: step response, lag at constant speed, friction, backlash.
#include "simulation/run/servo.h"

#include <array>
#include <cmath>
#include <complex>
#include <random>

#include <gtest/gtest.h>

namespace clsurf::servo_test {
namespace {

ServoModel ideal() {
    ServoModel model;
    model.velocity_feedforward = 0;
    model.quantum = 0;
    return model;
}

/// Position after a step of the command from 0 to 1 at t = 0: T x″ + x′ + K x = K, from rest.
double step_response(double gain, double time_constant, double t) {
    using Complex = std::complex<double>;
    const Complex root = std::sqrt(Complex(1 - 4 * gain * time_constant, 0));
    const Complex fast = (-1.0 - root) / (2 * time_constant), slow = (-1.0 + root) / (2 * time_constant);
    return (1.0 + (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (slow - fast)).real();
}

TEST(Servo, StepResponseIsThatOfTheSecondOrderLoop) {
    // Over-damped, nearly critically damped (4 K T = 1), and under-damped.
    for (const auto& [gain, time_constant] : {std::pair{50.0, 0.002}, {120.0, 0.0021}, {100.0, 0.01}}) {
        ServoModel model = ideal();
        model.position_gain = gain;
        model.velocity_time_constant = time_constant;
        constexpr double period = 1e-6;
        ServoLoop loop(model, period, 0, 1);
        double greatest = 0;
        for (int i = 1; i <= 100000; ++i) {
            const double x = loop.follow(1);
            greatest = std::max(greatest, x);
            if (i % 1000 != 0) continue;
            ASSERT_NEAR(x, step_response(gain, time_constant, i * period), 2e-4) << gain << " " << i;
        }
        // The overshoot of a damping ratio: exp(−π ζ/√(1 − ζ²)), ζ = 1/(2 √(K T)).
        const double damping = 1 / (2 * std::sqrt(gain * time_constant));
        const double overshoot = damping < 1 ? std::exp(-M_PI * damping / std::sqrt(1 - damping * damping)) : 0;
        const double last = step_response(gain, time_constant, 100000 * period);
        EXPECT_NEAR(greatest, damping < 0.9 ? 1 + overshoot : last, 1e-3);
    }
}

TEST(Servo, LagAtConstantSpeed) {
    for (const double feedforward : {0.0, 0.5, 0.96, 1.0}) {
        ServoModel model = ideal();
        model.velocity_feedforward = feedforward;
        constexpr double speed = 100, period = 0.0005;
        ServoLoop loop(model, period, 0, 1);
        double lag = 0;
        for (int i = 1; i <= 4000; ++i) lag = i * period * speed - loop.follow(i * period * speed);
        // v (1 − c)/Kv, for the command of the previous period: the lag is read a period later.
        EXPECT_NEAR(lag, speed * (1 - feedforward) / model.position_gain, 1e-6) << feedforward;
    }
}

TEST(Servo, FrictionAddsItsShareToTheLag) {
    constexpr double speed = 50, period = 0.0005;
    double lag[2];
    for (const int with : {0, 1}) {
        ServoModel model = ideal();
        model.friction = with * 2.0;
        ServoLoop loop(model, period, 0, 1);
        for (int i = 1; i <= 4000; ++i) lag[with] = i * period * speed - loop.follow(i * period * speed);
    }
    EXPECT_NEAR(lag[1] - lag[0], 2.0 / ideal().position_gain, 1e-9);
}

TEST(Servo, FrictionAddsNothingToTheLagOfALoopThatIntegrates) {
    constexpr double speed = 50, period = 0.0005;
    ServoModel model = ideal();
    model.velocity_integral_time = 0.02;
    model.friction = 2;
    ServoLoop loop(model, period, 0, 1);
    double lag = 0;
    for (int i = 1; i <= 8000; ++i) lag = i * period * speed - loop.follow(i * period * speed);
    ServoLoop without(ideal(), period, 0, 1);
    double expected = 0;
    for (int i = 1; i <= 8000; ++i) expected = i * period * speed - without.follow(i * period * speed);
    EXPECT_NEAR(lag, expected, 1e-9);
}

/// One period of T_v v′ = u − v + w, T_n w′ = u − v by the classical Runge–Kutta method.
std::array<double, 2> integrated(double time_constant, double integral_time, double period, double reference,
                                 std::array<double, 2> state) {
    const auto slope = [&](const std::array<double, 2>& at) {
        return std::array{(reference - at[0] + at[1]) / time_constant, (reference - at[0]) / integral_time};
    };
    const auto moved = [](const std::array<double, 2>& at, const std::array<double, 2>& by, double step) {
        return std::array{at[0] + step * by[0], at[1] + step * by[1]};
    };
    constexpr int steps = 400;
    const double h = period / steps;
    for (int i = 0; i < steps; ++i) {
        const auto a = slope(state), b = slope(moved(state, a, h / 2)), c = slope(moved(state, b, h / 2)),
                   d = slope(moved(state, c, h));
        for (std::size_t k = 0; k < 2; ++k) state[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
    }
    return state;
}

TEST(Servo, AStepOfTheVelocityLoopSolvesItsDifferentialEquation) {
    constexpr double period = 0.001, reference = 30, speed = 11, integral = -4;
    // Two real roots, a double one (T_n = 4 T_v), and complex ones.
    for (const double integral_time : {0.1, 0.012, 0.004}) {
        ServoModel model = ideal();
        model.velocity_time_constant = 0.003;
        model.velocity_integral_time = integral_time;
        const VelocityStep step = velocity_step_of(model, period);
        const auto [v, w] =
            integrated(model.velocity_time_constant, integral_time, period, reference, {speed, integral});
        EXPECT_NEAR(speed + step.by_error * (reference - speed) + step.by_integral * integral, v, 1e-9);
        EXPECT_NEAR(step.integral_by_error * (reference - speed) + step.integral_kept * integral, w, 1e-9);
    }
}

// A machine file may have any integral time of at least a period.
TEST(Servo, EveryLoopOfAMachineFileSettles) {
    std::mt19937_64 random(3);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int draw = 0; draw < 500; ++draw) {
        constexpr double period = 0.001;
        ServoModel model = ideal();
        model.position_gain = std::exp(uniform(std::log(10), std::log(0.95 / period)));
        model.velocity_time_constant = uniform(0.02, 0.97) / model.position_gain;
        model.velocity_integral_time = std::exp(uniform(std::log(period), 0));
        ServoLoop loop(model, period, 0, 1);
        double position = 0;
        for (int i = 0; i < 20000; ++i) position = loop.follow(1);
        EXPECT_NEAR(position, 1, 1e-3) << model.position_gain << ' ' << model.velocity_time_constant << ' '
                                       << model.velocity_integral_time;
    }
}

TEST(Servo, BacklashIsLostAtAReversal) {
    ServoModel model = ideal();
    model.backlash = 0.02;
    constexpr double period = 0.0005;
    ServoLoop loop(model, period, 0, 1);
    double read = 0;
    for (int i = 0; i < 20000; ++i) read = loop.follow(1);
    EXPECT_NEAR(read, 1 - 0.01, 1e-9) << "the table hangs half the play behind";
    for (int i = 0; i < 20000; ++i) read = loop.follow(0);
    EXPECT_NEAR(read, 0.01, 1e-9);
}

TEST(Servo, ReadsWholeStepsOfTheEncoder) {
    ServoModel model = ideal();
    model.quantum = 0.001;
    ServoLoop loop(model, 0.0005, 0, 1);
    for (int i = 1; i <= 1000; ++i) {
        const double steps = loop.follow(0.00137 * i) / model.quantum;
        ASSERT_NEAR(steps, std::round(steps), 1e-6);
    }
}

}  // namespace
}  // namespace clsurf::servo_test
