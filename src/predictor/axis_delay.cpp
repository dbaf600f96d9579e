#include "predictor/axis_delay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace clsurf {
namespace {

constexpr PointIndex most_samples = 20'000;
constexpr double least_motion = 0.01;  ///< share of the squared speed: an axis with less has no known delay
// The rule of docs/design/predictor.md#5-separate-systematic-lag, point 4.
constexpr double least_explained = 0.5;  ///< share of the variance of the lag
constexpr double same_order = 0.5;       ///< share of the largest effect of a pair of axes

struct MovedAxis {
    std::size_t axis = 0;
    double delay = 0;
};

/// Velocity and position error of the axes at a point, and its lag.
struct FollowedPoint {
    Vec3 velocity, error, normal;
    double lag = 0;
};

std::vector<FollowedPoint> sample(const Defect& defect, const Trajectory& path, const Trajectory& measured,
                                  const Signals& signals) {
    PointIndex all = 0;
    for (const DefectSection& section : defect.sections) all += section.points.size();
    const PointIndex stride = std::max<PointIndex>(1, all / most_samples);
    std::vector<FollowedPoint> points;
    for (const DefectSection& section : defect.sections) {
        for (PointIndex i = section.points.first + 1; i < section.points.last; i += stride) {
            FollowedPoint p;
            p.velocity = (path.at(i + 1) - path.at(i - 1)) / (2 * path.period);
            p.error = measured.at(i) - path.at(i);
            p.normal = signals.normal(i).cast<double>();
            p.lag = static_cast<double>(signals[i].normal_deviation);
            if (p.velocity.allFinite() && p.error.allFinite() && p.normal.allFinite() && std::isfinite(p.lag))
                points.push_back(p);
        }
    }
    return points;
}

std::vector<MovedAxis> delays_of(const std::vector<FollowedPoint>& points) {
    Vec3 squares = Vec3::Zero(), products = Vec3::Zero();
    for (const FollowedPoint& p : points) {
        squares += p.velocity.cwiseProduct(p.velocity);
        products += p.velocity.cwiseProduct(p.error);
    }
    std::vector<MovedAxis> moved;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<Eigen::Index>(axis);
        if (squares[k] > least_motion * squares.sum()) moved.push_back({axis, -products[k] / squares[k]});
    }
    return moved;
}

/// Share of the variance of the lag that the delays explain.
double explained(const std::vector<FollowedPoint>& points, const std::vector<MovedAxis>& moved) {
    double left = 0, all = 0;
    for (const FollowedPoint& p : points) {
        double lag = 0;
        for (const MovedAxis& m : moved) {
            const auto k = static_cast<Eigen::Index>(m.axis);
            lag -= p.normal[k] * m.delay * p.velocity[k];
        }
        left += (p.lag - lag) * (p.lag - lag);
        all += p.lag * p.lag;
    }
    return all > 0 ? 1 - left / all : 0;
}

/// The delays of the axes of all pairs whose difference moves the tool off its path about as much as the difference of the
/// strongest pair.
std::vector<AxisDelay> differing(const std::vector<FollowedPoint>& points, const std::vector<MovedAxis>& moved) {
    constexpr std::array<char, 3> letters{'x', 'y', 'z'};
    const auto effect = [&](const MovedAxis& a, const MovedAxis& b) {
        double sum = 0;
        for (const FollowedPoint& p : points) {
            const double speed = p.velocity.norm();
            if (speed > 0)
                sum += std::abs(p.velocity[static_cast<Eigen::Index>(a.axis)] *
                                p.velocity[static_cast<Eigen::Index>(b.axis)]) /
                       speed;
        }
        return std::abs(a.delay - b.delay) * sum;
    };
    double most = 0;
    for (const MovedAxis& a : moved) {
        for (const MovedAxis& b : moved) most = std::max(most, effect(a, b));
    }
    std::vector<AxisDelay> delays;
    for (const MovedAxis& a : moved) {
        const bool differs = std::any_of(moved.begin(), moved.end(), [&](const MovedAxis& b) {
            return most > 0 && effect(a, b) >= same_order * most;
        });
        if (differs) delays.push_back({letters.at(a.axis), a.delay});
    }
    std::sort(delays.begin(), delays.end(), [](const AxisDelay& a, const AxisDelay& b) { return a.delay > b.delay; });
    return delays;
}

}  // namespace

void explain_systematic_lag(QualityReport& report, const Trajectory& path, const Trajectory& measured,
                            const Signals& signals) {
    if (path.kinematics) return;
    for (Defect& defect : report.defects) {
        if (!defect.systematic) continue;
        const std::vector<FollowedPoint> points = sample(defect, path, measured, signals);
        const std::vector<MovedAxis> moved = delays_of(points);
        if (explained(points, moved) >= least_explained) defect.delays = differing(points, moved);
    }
}

}  // namespace clsurf
