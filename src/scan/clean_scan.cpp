#include "scan/clean_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr std::size_t width = 9;    ///< places of the running median
constexpr std::size_t around = 10;  ///< places on each side for the local scatter

/// Points of the same x.
struct ScannedPlace {
    ScanPoint middle;  ///< its z is the median of the points
    std::size_t first = 0, end = 0;
};

std::vector<ScannedPlace> places_of(std::span<const ScanPoint> points) {
    std::vector<ScannedPlace> places;
    std::vector<double> heights;
    for (std::size_t i = 0; i < points.size();) {
        ScannedPlace place{{points[i].x, 0}, i, i};
        heights.clear();
        for (; place.end < points.size() && points[place.end].x == points[i].x; ++place.end)
            heights.push_back(points[place.end].z);
        place.middle.z = midpoint_median(heights);
        places.push_back(place);
        i = place.end;
    }
    return places;
}

/// Siegel's repeated median of the slopes between places.
double median_slope(std::span<const ScannedPlace> places) {
    std::array<double, width> of_place{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::array<double, width> slopes{};
        std::size_t n = 0;
        const ScanPoint& a = places[i].middle;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const ScanPoint& b = places[k].middle;
            if (k != i) slopes[n++] = (b.z - a.z) / (b.x - a.x);
        }
        of_place[i] = midpoint_median(std::span(slopes).first(n));
    }
    return midpoint_median(of_place);
}

/// Height of each point above the running median.
std::vector<double> heights_above_median(std::span<const ScanPoint> points, std::span<const ScannedPlace> places) {
    std::vector<double> heights(points.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t first = std::min(i < width / 2 ? 0 : i - width / 2, places.size() - width);
        const std::span<const ScannedPlace> window = places.subspan(first, width);
        const double slope = median_slope(window);
        std::array<double, width> moved{};
        for (std::size_t k = 0; k < width; ++k)
            moved[k] = window[k].middle.z - slope * (window[k].middle.x - places[i].middle.x);
        const double median_here = midpoint_median(moved);
        for (std::size_t k = places[i].first; k < places[i].end; ++k) heights[k] = points[k].z - median_here;
    }
    return heights;
}

/// Excludes points that are the running median themselves: their distance is 0 for any scatter.
double scatter_of(std::vector<double>& values) {
    std::erase(values, 0.0);
    if (values.empty()) return 0;
    for (double& value : values) value = std::abs(value);
    return deviation_of_mad * median(values);
}

/// The least step of heights: steps of the instrument's resolution on a plane are no scatter. The rounding is relative to
/// the usual height: a single one may be a code for a missing value, for example 1e300.
double resolution_of(std::span<const ScanPoint> points) {
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> heights;
    for (std::size_t i = 0; i < points.size(); ++i) {
        heights.push_back(std::abs(points[i].z));
        const double step = i > 0 ? std::abs(points[i].z - points[i - 1].z) : 0;
        if (step > 0) least = std::min(least, step);
    }
    constexpr double rounding = 1e-12;
    return std::max(std::isfinite(least) ? least : 0, rounding * median(heights));
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
    const std::vector<ScannedPlace> places = places_of(points);
    if (places.size() < width) {
        kept.assign(points.begin(), points.end());
        average_same_places(kept, scan);
        return scan;
    }
    const std::vector<double> heights = heights_above_median(points, places);
    std::vector<double> all = heights;
    scan.scatter = scatter_of(all);
    const double least = std::max(scan.scatter, resolution_of(points));
    const auto at = [&](std::size_t point) { return heights.begin() + static_cast<std::ptrdiff_t>(point); };
    std::vector<double> local;
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = places[i].first; k < places[i].end; ++k) {
            bool outlier = threshold > 0 && std::abs(heights[k]) > threshold * least;
            if (outlier) {
                local.assign(at(places[i < around ? 0 : i - around].first),
                             at(places[std::min(places.size() - 1, i + around)].end));
                outlier = std::abs(heights[k]) > threshold * scatter_of(local);
            }
            (outlier ? scan.rejected : kept).push_back(points[k]);
        }
    }
    average_same_places(kept, scan);
    return scan;
}

}  // namespace clsurf
