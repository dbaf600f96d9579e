// ServoLoop against the closed forms of a second-order loop: step response, lag at constant speed, friction, backlash.
#include "simulation/run/servo.h"

#include <cmath>
#include <complex>

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
    // Over-damped, near critical (4 K T = 1), and one that overshoots.
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
        // v (1 − c)/Kv, of the command of the period before: the lag is read a period later.
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
