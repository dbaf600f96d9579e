#include "numeric/resolved_curvature.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "numeric/polyline.h"

namespace clsurf {
namespace {

constexpr double resolved = 0.1;                ///< greatest error over curvature
constexpr double unknown = 0.5;                 ///< standard error over curvature at which nothing is known
constexpr std::size_t most_points = 31;         ///< fitted points of a section; more would only take longer
constexpr double much_shorter = 0.5;            ///< share of the reach: points resolved over less bound a section
constexpr double growth = std::numbers::sqrt2;  ///< growth of the sections from one attempt to the next

struct Estimate {
    double curvature = 0, standard_error = 0;  ///< [1/mm]
    /// [1/mm] of rounding in the worst case. The standard error is not a suitable stopping criterion: of thousands of
    /// points, those stop first whose error makes the curvature large, and the greatest of them limits the speed. Along an
    /// axis the roundings of dense points are not independent either: they are the steps of a staircase.
    double greatest_error = 0;
};

/// Points first … last.
struct Section {
    std::size_t first = 0, last = 0;
};

class RoundedPath {
public:
    /// `step` [mm]: of the coordinates
    RoundedPath(std::span<const Vec3> points, double step)
        : points_(points), step_(step), deviation_(step / std::sqrt(12.0)) {
        arc_length_.assign(points.size(), 0);
        for (std::size_t i = 1; i < points.size(); ++i)
            arc_length_[i] = arc_length_[i - 1] + (points[i] - points[i - 1]).norm();
    }

    [[nodiscard]] Estimate of_neighbours(std::size_t i) const {
        const double before = between(i - 1, i), after = between(i, i + 1), shorter = std::min(before, after);
        const Vec3 bend = (points_[i + 1] - points_[i]) / after - (points_[i] - points_[i - 1]) / before;
        return {three_point_curvature(points_[i - 1], points_[i], points_[i + 1]),
                std::sqrt(6.0) * deviation_ / (shorter * shorter), 2 * step_ * along(bend) / (before * after)};
    }

    /// The points within `reach` [mm] of `at` on each side, inside `bounds`: if one side is too short, the other is
    /// extended.
    [[nodiscard]] Section around(std::size_t at, double reach, const Section& bounds) const {
        const double before = between(bounds.first, at), after = between(at, bounds.last);
        const double to_left = std::min(before, std::max(reach, 2 * reach - after));
        const double to_right = std::min(after, std::max(reach, 2 * reach - before));
        const auto begin = arc_length_.begin();
        const auto low = std::lower_bound(begin + static_cast<std::ptrdiff_t>(bounds.first),
                                          begin + static_cast<std::ptrdiff_t>(at), arc_length_[at] - to_left);
        const auto high =
            std::upper_bound(begin + static_cast<std::ptrdiff_t>(at),
                             begin + static_cast<std::ptrdiff_t>(bounds.last) + 1, arc_length_[at] + to_right);
        return {std::min(static_cast<std::size_t>(low - begin), at - 1),
                std::max(static_cast<std::size_t>(high - begin) - 1, at + 1)};
    }

    /// By a parabola over the arc length.
    [[nodiscard]] Estimate fit(const Section& section, std::size_t at) const {
        const double scale = std::max(between(section.first, at), between(at, section.last));
        const std::size_t stride = (section.last - section.first + most_points - 1) / most_points;
        const auto each = [&](const auto& add) {
            const auto one = [&](std::size_t i) {
                const double u = (arc_length_[i] - arc_length_[at]) / scale;
                add(i, Vec3(1, u, u * u));
            };
            // From both ends, so that both directions of travel give the same result.
            std::size_t low = section.first, high = section.last;
            for (; low < high; low += stride, high -= stride) {
                one(low);
                one(high);
            }
            if (low == high) one(low);
        };
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
        each([&](std::size_t i, const Vec3& powers) {
            normal += powers * powers.transpose();
            right += powers * (points_[i] - points_[at]).transpose();
        });
        const Eigen::Matrix3d inverse = normal.inverse();
        const Eigen::Matrix3d coefficients = inverse * right;
        const Vec3 first = coefficients.row(1) / scale, second = 2 * coefficients.row(2) / (scale * scale);
        double weights = 0;  // of the points in the quadratic coefficient
        each([&](std::size_t, const Vec3& powers) { weights += std::abs(inverse.row(2) * powers); });
        const double speed = first.norm();
        const Vec3 bend = second - second.dot(first) / (speed * speed) * first;
        return {second.cross(first).norm() / (speed * speed * speed),
                2 * deviation_ * std::sqrt(inverse(2, 2)) / (scale * scale),
                step_ * along(bend) * weights / (scale * scale)};
    }

private:
    /// How far rounding moves a point along a direction, relative to along an axis: 1 along an axis, √2 halfway between
    /// two.
    static double along(const Vec3& direction) {
        const double length = direction.norm();
        return length > 0 ? direction.lpNorm<1>() / length : 1;
    }

    [[nodiscard]] double between(std::size_t i, std::size_t k) const { return arc_length_[k] - arc_length_[i]; }

    std::span<const Vec3> points_;
    double step_;       ///< of the coordinates [mm]
    double deviation_;  ///< standard, of a coordinate [mm]
    std::vector<double> arc_length_;
};

/// The nearest points on both sides of each open point that were resolved over less than `reach` [mm], or the ends of the
/// path. `resolved_over` [mm]: infinite for an open point.
std::vector<Section> bounds_of(const std::vector<std::size_t>& open, const std::vector<double>& resolved_over,
                               double reach) {
    std::vector<Section> bounds(open.size());
    std::size_t bound = 0, i = 0;
    for (std::size_t k = 0; k < open.size(); ++k) {
        for (; i < open[k]; ++i) {
            if (resolved_over[i] < reach) bound = i;
        }
        bounds[k].first = bound;
    }
    bound = i = resolved_over.size() - 1;
    for (std::size_t k = open.size(); k-- > 0;) {
        for (; i > open[k]; --i) {
            if (resolved_over[i] < reach) bound = i;
        }
        bounds[k].last = bound;
    }
    return bounds;
}

}  // namespace

std::vector<double> resolved_curvatures(std::span<const Vec3> points, double step, double least,
                                        Unresolved unresolved) {
    const std::size_t n = points.size();
    std::vector<double> result(n, 0);
    if (n < 3) return result;
    const RoundedPath path(points, step);
    const auto is_resolved = [&](const Estimate& e) {
        return e.greatest_error <= resolved * std::max(e.curvature, least);
    };
    std::vector<std::size_t> open;
    std::vector<double> resolved_over(n, std::numeric_limits<double>::infinity());
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const Estimate estimate = path.of_neighbours(i);
        result[i] = estimate.curvature;
        if (is_resolved(estimate))
            resolved_over[i] = 0;
        else
            open.push_back(i);
    }
    const double widest = std::sqrt(step / (resolved * least));
    for (double reach = growth * step; !open.empty(); reach *= growth) {
        const std::vector<Section> bounds = bounds_of(open, resolved_over, much_shorter * reach);
        std::vector<std::size_t> still_open;
        for (std::size_t k = 0; k < open.size(); ++k) {
            const Section section = path.around(open[k], reach, bounds[k]);
            const bool can_grow = reach < widest && (section.first > bounds[k].first || section.last < bounds[k].last);
            if (section.last - section.first == 2 && can_grow) {
                still_open.push_back(open[k]);
                continue;
            }
            const Estimate estimate = path.fit(section, open[k]);
            if (is_resolved(estimate) || !can_grow) {
                const bool known = unresolved == Unresolved::best ||
                                   estimate.standard_error <= unknown * std::max(estimate.curvature, least);
                result[open[k]] = known ? estimate.curvature : std::numeric_limits<double>::quiet_NaN();
                resolved_over[open[k]] = reach;
            } else {
                still_open.push_back(open[k]);
            }
        }
        open = std::move(still_open);
    }
    result.front() = result[1];
    result.back() = result[n - 2];
    return result;
}

}  // namespace clsurf
