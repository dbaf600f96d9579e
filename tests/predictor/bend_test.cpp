// Bends: which slow places are explained by the layout of the passes.
#include "predictor/bend.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/stitched_path.h"

namespace clsurf::bend_test {
namespace {

constexpr double apart = 0.3, outer = 20, fine = 0.01;
constexpr double feed = 100, slow = 40, acceleration = 2000;  // mm/s, mm/s²
constexpr int turns = 9, slow_turn = 5;

/// A path of many small chords, and the arc length at which the tool is slowest.
struct SlowPath {
    std::vector<Vec3> points;
    double slowest = 0;

    void add(double radius, double angle) {
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    [[nodiscard]] double length() const { return static_cast<double>(points.size() - 1) * fine; }
};

/// Closed circles. Each is left on a slanted link of 2.4 mm, 7° inwards, to the beginning of the next one.
SlowPath circles_joined_on_a_slant() {
    constexpr double slant = 2.4;
    SlowPath path;
    double begin = 0;
    for (int k = 0; k < turns; ++k) {
        const double radius = outer - k * apart;
        const auto round = static_cast<int>(2 * std::numbers::pi * radius / fine),
                   link = static_cast<int>(slant / fine);
        for (int i = 0; i < round; ++i) path.add(radius, begin + 2 * std::numbers::pi * i / round);
        if (k == slow_turn) path.slowest = path.length() + 0.5 * slant;
        for (int i = 0; i < link; ++i) path.add(radius - apart * i / link, begin + slant / radius * i / link);
        begin += slant / radius;
    }
    return path;
}

SlowPath spiral() {
    SlowPath path;
    for (double angle = 0; angle < 2 * std::numbers::pi * turns;) {
        const double radius = outer - apart * angle / (2 * std::numbers::pi);
        path.add(radius, angle);
        angle += fine / radius;
        if (angle < 2 * std::numbers::pi * slow_turn) path.slowest = path.length();
    }
    return path;
}

/// Whether a bend explains that the tool is slow there. The tool brakes and accelerates as usual.
bool explained(const SlowPath& path) {
    constexpr double period = 0.001;
    Positions positions;
    std::vector<float> speeds;
    PointIndex slowest = 0;
    for (double s = 0; s < path.length();) {
        const double speed = std::min(feed, std::sqrt(slow * slow + 2 * acceleration * std::abs(s - path.slowest)));
        const Vec3& at = path.points[static_cast<std::size_t>(s / fine)];
        test::add(positions, at.x(), at.y(), at.z());
        speeds.push_back(static_cast<float>(speed));
        if (s <= path.slowest) slowest = positions.size() - 1;
        s += speed * period;
    }
    const ClSurface surface = test::surface_of(std::move(positions), apart);
    Signals signals;
    signals.samples.resize(speeds.size());
    for (PointIndex i = 1; i + 1 < signals.size(); ++i) {
        Sample& sample = signals[i];
        sample.speed = speeds[static_cast<std::size_t>(i)];
        const Eigen::Vector3f along = (surface.positions[i + 1] - surface.positions[i - 1]).normalized();
        const float rise = (speeds[static_cast<std::size_t>(i + 1)] - speeds[static_cast<std::size_t>(i - 1)]) /
                           static_cast<float>(2 * period);
        Eigen::Map<Eigen::Vector3f>(sample.feed) = along;
        Eigen::Map<Eigen::Vector3f>(sample.acceleration) = rise * along;
        Eigen::Map<Eigen::Vector3f>(sample.normal) = Eigen::Vector3f::UnitZ();
        sample.zone = Zone::inner;
    }
    Thresholds thresholds;
    thresholds.of.fill(0.03F);
    thresholds.usual_speed = static_cast<float>(feed);
    thresholds.usual_acceleration = static_cast<float>(acceleration);
    Comparison comparison{};
    comparison.residual[index_of(Quantity::speed)] = -0.6F;
    return Bends(surface, signals, thresholds).explain(slowest, comparison);
}

TEST(Bends, ASlantingLinkFromAClosedLoopToTheNextIsOne) { EXPECT_TRUE(explained(circles_joined_on_a_slant())); }

TEST(Bends, ASpiralHasNone) { EXPECT_FALSE(explained(spiral())); }

TEST(Bends, ACircleAwayFromItsLinkHasNone) {
    SlowPath path = circles_joined_on_a_slant();
    path.slowest -= 30;
    EXPECT_FALSE(explained(path));
}

}  // namespace
}  // namespace clsurf::bend_test
