#pragma once
// Constant-speed intervals: a pass divided where its curvature or its point spacing changes, so that each
// interval can be run at one speed.
//
// After Wu et al., Speed Planning in the Constant Speed Interval, Machines 10 (2022) 558, with these
// differences: curvature replaces its radius (a line is 0, not infinite); polyline reduction finds the
// characteristic points; a boundary moves to the point of largest change, so that both directions of travel
// give the same result; an interval over which curvature drifts is divided; the speed limits the normal
// acceleration at the maximum curvature, not only at the mean (intervals/intervals.h).

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

struct IntervalRules {
    double error = 0.01;           ///< [mm] largest distance of the pass from the polyline of its characteristic points
    double length_ratio = 5;       ///< ratio of adjacent lines beyond which their common point bounds an interval
    double curvature_ratio = 2;    ///< ratio of the curvatures before and after a point, likewise
    double flat_curvature = 1e-3;  ///< [1/mm] smaller curvatures count as this
    double drift_ratio = 4;        ///< greatest over least curvature inside; 0: not checked
    double greatest_length = 0;    ///< [mm] greatest length of an interval; 0: not bounded
    double coordinate_step = 0;    ///< [mm] step to which coordinates are rounded (resolved_curvature.h); 0: exact
};

/// Points first … last of a pass; neighbours share the point between them.
struct SpeedInterval {
    std::size_t first = 0, last = 0;
    double mean_curvature = 0;      ///< [1/mm] of the inner points, weighted by arc length
    double greatest_curvature = 0;  ///< [1/mm] of the inner points
};

/// Curvature of the circle through each point and its neighbours [1/mm]. The ends have the curvature of the next inner
/// point; infinite if the path turns back.
[[nodiscard]] std::vector<double> curvatures(std::span<const Vec3> points);

/// Indices of the points that form a simpler polyline within `error` [mm] of all points (Douglas and Peucker),
/// including both ends; a closed one is first cut at the point farthest from its start.
[[nodiscard]] std::vector<std::size_t> characteristic_points(std::span<const Vec3> points, double error);

/// The boundaries of the intervals of a pass, including both ends. No two neighbouring points are the same.
[[nodiscard]] std::vector<std::size_t> interval_boundaries(std::span<const Vec3> points,
                                                           std::span<const double> curvature,
                                                           const IntervalRules& rules);

/// The curvatures for these rules: of the neighbouring points or, if coordinates are rounded, resolved ones.
[[nodiscard]] std::vector<double> curvatures(std::span<const Vec3> points, const IntervalRules& rules);

/// The same boundaries, moved to the exact points of steps in curvature, with further ones where curvature drifts or an
/// interval would get too long. Curvatures that were measured across a step are measured again on one side of it.
[[nodiscard]] std::vector<std::size_t> all_boundaries(std::span<const Vec3> points, std::span<double> curvature,
                                                      const IntervalRules& rules);

/// The intervals from each boundary to the next.
[[nodiscard]] std::vector<SpeedInterval> intervals_between(std::span<const Vec3> points,
                                                           std::span<const double> curvature,
                                                           std::span<const std::size_t> boundaries);

/// The intervals of a pass; none for a single point. O(points log points).
[[nodiscard]] std::vector<SpeedInterval> divide(std::span<const Vec3> points, const IntervalRules& rules);

}  // namespace clsurf
