// Standard deviations where the acceleration jumps, as with a control without a jerk limit: compared with the truth of a made
// motion, from noisy positions alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "toolpath/motion_estimate.h"

namespace clsurf::acceleration_corners_test {
namespace {

constexpr double period = 0.001;

/// Lines of 40 mm back and forth in X over a wave in Z, each from rest to rest with 1,500 mm/s², slower in two places.
struct Trapezoids {
    std::array<std::vector<double>, 3> positions;
    std::vector<double> speed;  ///< true [mm/s]
    std::vector<PointRange> pieces;
    Log log;

    explicit Trapezoids(int lines) {
        std::mt19937 random(3);
        std::normal_distribution<double> noise(0, 0.0003);
        std::uniform_real_distribution<double> place(5, 33);
        for (int line = 0; line < lines; ++line) {
            const auto first = static_cast<PointIndex>(speed.size());
            add_line(line % 2 == 0, {place(random), place(random)});
            pieces.push_back({first, static_cast<PointIndex>(speed.size()) - 1});
        }
        for (std::vector<double>& axis : positions) {
            for (double& p : axis) p = std::round((p + noise(random)) / 0.001) * 0.001;
        }
        log.name = "trapezoids";
        log.period = period;
        log.records = static_cast<PointIndex>(speed.size());
        for (std::size_t k = 0; k < 3; ++k)
            log.channels.push_back({std::string("cmd.") + "xyz"[k],
                                    "mm",
                                    {reinterpret_cast<const std::byte*>(positions[k].data()), 8, log.records,
                                     ScalarType::f64, false, 1, 0}});
    }

private:
    static constexpr double length = 40, acceleration = 1500, fast = 50, slow = 20;

    static double height(double x) { return 2 * std::cos(2 * M_PI * (x - 20) / 17); }
    /// The highest speed from which the tool can still slow down for the next slow place, and stop at the end.
    static double limit(double x, const std::array<double, 2>& slow_places) {
        double most = std::min(fast, std::sqrt(2 * acceleration * std::max(0.0, length - x)));
        for (const double at : slow_places) {
            if (x >= at && x < at + 2) most = std::min(most, slow);
            if (x < at) most = std::min(most, std::sqrt(slow * slow + 2 * acceleration * (at - x)));
        }
        return most;
    }
    void add_line(bool forth, const std::array<double, 2>& slow_places) {
        constexpr int fine = 200;
        constexpr double step = period / fine;
        double way = 0, v = 0;
        for (int i = 0; way < length - 1e-4 && i < 5000; ++i) {
            const double x = forth ? way : length - way;
            const double slope = (height(x + 1e-4) - height(x - 1e-4)) / 2e-4;
            positions[0].push_back(x);
            positions[1].push_back(0);
            positions[2].push_back(height(x));
            speed.push_back(v * std::hypot(1, slope));
            for (int f = 0; f < fine; ++f) {
                v = std::max(0.02, std::min(v + acceleration * step, limit(way, slow_places)));
                way += v * step;
            }
        }
    }
};

TEST(AccelerationCorners, ThreeDeviationsHoldTheErrorsOfTrapezoidalSpeeds) {
    const Trapezoids made(12);
    const Trajectory path = reconstruct(made.log, Role::commanded, Vec3::Zero());
    const MotionEstimate estimate(made.log, path, made.pieces);
    double held = 0, count = 0, squares = 0;
    for (const PointRange& piece : made.pieces) {
        MotionEstimate::Scratch scratch;
        std::array<std::array<std::vector<double>, 3>, 4> out;
        estimate.estimate(piece, piece.first, piece.last, scratch, out);
        std::vector<double> sigmas(static_cast<std::size_t>(piece.size()));
        estimate.sigmas(1, piece, piece.first, scratch, sigmas);
        for (std::size_t i = 0; i < sigmas.size(); ++i) {
            const double v = Vec3(out[1][0][i], out[1][1][i], out[1][2][i]).norm();
            const double off = (v - made.speed[static_cast<std::size_t>(piece.first) + i]) / sigmas[i];
            held += std::abs(off) <= 3 ? 1 : 0;
            squares += off * off;
            ++count;
        }
    }
    EXPECT_GE(held / count, 0.99);
    EXPECT_LT(squares / count, 2) << "normalised estimation error squared, against the truth";
}

}  // namespace
}  // namespace clsurf::acceleration_corners_test
