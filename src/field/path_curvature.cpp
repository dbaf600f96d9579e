#include "field/path_curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/not_finite.h"
#include "core/statistics.h"
#include "core/units.h"
#include "log/quantum.h"
#include "numeric/resolved_curvature.h"

namespace clsurf {
namespace {

constexpr double finest_step = 1e-6;               ///< [mm]
constexpr double least_curvature = 1e-3;           ///< [1/mm] a path with a radius of 1 m counts as straight
constexpr double apart = 2;                        ///< steps between points that differ
constexpr double corner_reach = 0.1;               ///< [mm] of a corner on each side of its middle
constexpr double corner_angle = 45 * rad_per_deg;  ///< a smaller one is curvature, as of programmed paths
constexpr PointIndex sample_points = 512;          ///< number of points of a section from which noise is measured
constexpr PointIndex samples = 16;

using Columns = std::array<std::vector<double>, 3>;

void read(const Trajectory& path, PointIndex first, PointIndex count, Columns& p) {
    for (std::vector<double>& axis : p) axis.resize(static_cast<std::size_t>(count));
    path.read(first, p[0], p[1], p[2]);
}

/// The step [mm] whose rounding has the deviation of the noise: from third differences, which are nearly zero for a smooth
/// motion. Third differences of noise with the deviation σ have the deviation √20 σ.
double step_of_noise(const Trajectory& path) {
    std::vector<double> differences;
    Columns p;
    const PointIndex count = std::min(sample_points, path.count);
    for (PointIndex k = 0; k < samples; ++k) {
        read(path, (path.count - count) * k / std::max<PointIndex>(1, samples - 1), count, p);
        for (const std::vector<double>& axis : p) {
            for (std::size_t i = 3; i < axis.size(); ++i) {
                const double third = axis[i] - 3 * axis[i - 1] + 3 * axis[i - 2] - axis[i - 3];
                if (std::isfinite(third) && axis[i] != axis[i - 1]) differences.push_back(std::abs(third));
            }
        }
    }
    if (differences.empty()) return 0;
    const double deviation = deviation_of_mad * median(differences) / std::sqrt(20.0);
    return std::sqrt(12.0) * deviation;
}

double step_of_rounding(const Log& log, Role role) {
    double step = finest_step;
    for (const char letter : {'x', 'y', 'z'}) {
        if (const Channel* channel = log.find(std::string(prefix_of(role)) + "." + letter))
            step = std::max(step, resolution_of(channel->values));
    }
    return step;
}

/// No value in corners, for example those that controllers round between passes: they would hide the curvature of the
/// surface.
void leave_out_corners(const std::vector<Vec3>& points, std::vector<double>& curvature) {
    std::vector<double> arc_length(points.size(), 0);
    for (std::size_t i = 1; i < points.size(); ++i)
        arc_length[i] = arc_length[i - 1] + (points[i] - points[i - 1]).norm();
    std::size_t before = 0, after = 0, left_out = 0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        while (before + 1 < i && arc_length[i] - arc_length[before + 1] >= corner_reach) ++before;
        while (after + 1 < points.size() && (after <= i || arc_length[after] - arc_length[i] < corner_reach)) ++after;
        if (angle_between(points[i] - points[before], points[after] - points[i]) <= corner_angle) continue;
        std::size_t k = std::max(before, left_out);
        for (; k <= after; ++k) curvature[k] = missing<double>;
        left_out = k;
    }
}

}  // namespace

PathCurvature::PathCurvature(const Log& log, const Trajectory& path)
    : path_(path), step_(std::max(step_of_rounding(log, path.role), step_of_noise(path))) {}

void PathCurvature::compute(PointIndex first, std::span<double> out) const {
    const PointIndex last = first + static_cast<PointIndex>(out.size()) - 1;
    const PointIndex from = std::max<PointIndex>(0, first - reach);
    const PointIndex to = std::min(path_.count - 1, last + reach);
    Columns p;
    read(path_, from, to - from + 1, p);
    std::vector<Vec3> points;
    std::vector<std::size_t> kept(out.size(), 0);  // for each requested point, the kept point before it, or itself
    const auto finish = [&](PointIndex begin, PointIndex end) {
        std::vector<double> curvature = resolved_curvatures(points, step_, least_curvature, Unresolved::no_value);
        leave_out_corners(points, curvature);
        for (PointIndex i = std::max(begin, first); i < std::min(end, last + 1); ++i) {
            double& value = out[static_cast<std::size_t>(i - first)];
            value = curvature.size() < 3 ? missing<double> : curvature[kept[static_cast<std::size_t>(i - first)]];
            if (!std::isfinite(value)) value = missing<double>;
        }
        points.clear();
    };
    PointIndex begin = from;
    for (PointIndex i = from; i <= to; ++i) {
        const auto at = static_cast<std::size_t>(i - from);
        const Vec3 here(p[0][at], p[1][at], p[2][at]);
        if (!here.allFinite()) {
            finish(begin, i);
            begin = i + 1;
            if (i >= first && i <= last) out[static_cast<std::size_t>(i - first)] = missing<double>;
            continue;
        }
        if (points.empty() || (here - points.back()).norm() > apart * step_) points.push_back(here);
        if (i >= first && i <= last) kept[static_cast<std::size_t>(i - first)] = points.size() - 1;
    }
    finish(begin, to + 1);
}

}  // namespace clsurf
