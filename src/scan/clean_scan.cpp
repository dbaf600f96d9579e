#include "scan/clean_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr std::size_t width = 5;

/// Siegel's repeated median of the slopes between points.
double median_slope(std::span<const ScanPoint> points) {
    std::array<double, width> of_point{};
    std::size_t count = 0;
    for (const ScanPoint& a : points) {
        std::array<double, width> slopes{};
        std::size_t n = 0;
        for (const ScanPoint& b : points) {
            if (b.x != a.x) slopes[n++] = (b.z - a.z) / (b.x - a.x);
        }
        if (n > 0) of_point[count++] = midpoint_median(std::span(slopes).first(n));
    }
    return count > 0 ? midpoint_median(std::span(of_point).first(count)) : 0;
}

/// How far each point lies above the running median.
std::vector<double> heights_above_median(std::span<const ScanPoint> points) {
    std::vector<double> heights(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t first = std::min(i < width / 2 ? 0 : i - width / 2, points.size() - width);
        const std::span<const ScanPoint> around = points.subspan(first, width);
        const double slope = median_slope(around);
        std::array<double, width> moved{};
        for (std::size_t k = 0; k < width; ++k) moved[k] = around[k].z - slope * (around[k].x - points[i].x);
        heights[i] = points[i].z - midpoint_median(moved);
    }
    return heights;
}

/// Without points that are the running median themselves: their distance is 0, whatever the scatter.
double scatter_of(std::vector<double>& values) {
    std::erase(values, 0.0);
    if (values.empty()) return 0;
    for (double& value : values) value = std::abs(value);
    return deviation_of_mad * median(values);
}

/// The least step of heights: what the resolution of an instrument makes of a plane is no scatter.
double resolution_of(std::span<const ScanPoint> points) {
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        largest = std::max(largest, std::abs(points[i].z));
        const double step = i > 0 ? std::abs(points[i].z - points[i - 1].z) : 0;
        if (step > 0) least = std::min(least, step);
    }
    constexpr double rounding = 1e-12;
    return std::max(std::isfinite(least) ? least : 0, rounding * largest);
}

void average_same_places(std::span<const ScanPoint> points, CleanScan& scan) {
    for (std::size_t i = 0; i < points.size();) {
        std::size_t end = i;
        double sum = 0;
        for (; end < points.size() && points[end].x == points[i].x; ++end) sum += points[end].z;
        scan.x.push_back(points[i].x);
        scan.z.push_back(sum / static_cast<double>(end - i));
        if (end - i > 1) scan.averaged += end - i;
        i = end;
    }
}

}  // namespace

CleanScan clean_scan(std::span<const ScanPoint> points, double threshold) {
    CleanScan scan;
    std::vector<ScanPoint> kept;
    if (points.size() < width) {
        kept.assign(points.begin(), points.end());
    } else {
        const std::vector<double> heights = heights_above_median(points);
        std::vector<double> all = heights;
        scan.scatter = scatter_of(all);
        const double least = std::max(scan.scatter, resolution_of(points));
        constexpr std::size_t around = 10;  // points on each side
        std::vector<double> local;
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool outlier = threshold > 0 && std::abs(heights[i]) > threshold * least;
            if (outlier) {
                const std::size_t first = i < around ? 0 : i - around;
                const std::size_t end = std::min(points.size(), i + around + 1);
                local.assign(heights.begin() + static_cast<std::ptrdiff_t>(first),
                             heights.begin() + static_cast<std::ptrdiff_t>(end));
                outlier = std::abs(heights[i]) > threshold * scatter_of(local);
            }
            (outlier ? scan.rejected : kept).push_back(points[i]);
        }
    }
    average_same_places(kept, scan);
    return scan;
}

}  // namespace clsurf
