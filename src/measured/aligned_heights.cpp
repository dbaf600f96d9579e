#include "measured/aligned_heights.h"

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr double most_gap = 3;       ///< spacings: largest gap between two places for an interpolation
constexpr int map_steps = 4;         ///< iterations for a map's column and row; few, because the tilt of a map is small
constexpr double most_values = 1e6;  ///< of a row

}  // namespace

AlignedHeights::AlignedHeights(const MeasuredData& measured, const Pose& pose) : measured_(measured), pose_(pose) {
    Box2 box;
    for (const Vec3& p : measured.points) {
        if (std::isfinite(p.z())) box.extend(Vec2(pose(p).head<2>()));
    }
    if (!box.isEmpty()) middle_ = box.center();
    if (measured.kind == MeasuredKind::areal) spacing_ = measured.spacing.minCoeff();
    if (measured.kind != MeasuredKind::profile || measured.points.size() < 2) return;
    from_ = pose(measured.points.front()).head<2>();
    along_ = (pose(measured.points.back()).head<2>() - from_).normalized();
    std::vector<double> steps;
    for (const Vec3& point : measured.points) {
        const Vec3 p = pose(point);
        const double distance = along_.dot(p.head<2>() - from_);
        if (!distance_.empty() && distance <= distance_.back()) continue;
        if (!distance_.empty()) steps.push_back(distance - distance_.back());
        distance_.push_back(distance);
        height_.push_back(p.z());
    }
    if (!steps.empty()) spacing_ = median(steps);
}

ProfileRow AlignedHeights::own_row(double least_step) const {
    if (distance_.size() < 2) return {};
    const double length = distance_.back();
    const double step = std::max({spacing_, least_step, length / most_values});
    return {from_, along_, step, static_cast<std::int64_t>(std::floor(length / step + 1e-9)) + 1};
}

double AlignedHeights::at(const Vec2& place) const {
    switch (measured_.kind) {
        case MeasuredKind::profile: return along_profile(place);
        case MeasuredKind::areal: return over_map(place);
        case MeasuredKind::points: break;
    }
    return missing<double>;
}

double AlignedHeights::along_profile(const Vec2& place) const {
    const double distance = along_.dot(place - from_);
    if (distance_.size() < 2 || !(distance >= distance_.front() && distance <= distance_.back()))
        return missing<double>;
    const auto above = std::upper_bound(distance_.begin(), distance_.end(), distance);
    const auto k = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - distance_.begin(), 1, static_cast<std::ptrdiff_t>(distance_.size()) - 1));
    const double step = distance_[k] - distance_[k - 1];
    if (step > most_gap * spacing_) return missing<double>;
    return height_[k - 1] + (distance - distance_[k - 1]) / step * (height_[k] - height_[k - 1]);
}

double AlignedHeights::map_height(double column, double row) const {
    const double left = std::floor(column);
    const double below = std::floor(row);
    if (!(left >= 0 && below >= 0 && left + 1 < static_cast<double>(measured_.columns) &&
          below + 1 < static_cast<double>(measured_.rows)))
        return missing<double>;
    const auto first =
        static_cast<std::size_t>(below) * static_cast<std::size_t>(measured_.columns) + static_cast<std::size_t>(left);
    const auto wide = static_cast<std::size_t>(measured_.columns);
    const auto z = [&](std::size_t k) { return measured_.points[k].z(); };
    const double x = column - left;
    const double low = z(first) + x * (z(first + 1) - z(first));
    const double high = z(first + wide) + x * (z(first + wide + 1) - z(first + wide));
    return low + (row - below) * (high - low);
}

double AlignedHeights::over_map(const Vec2& place) const {
    const Eigen::Matrix2d plan = pose_.turn.topLeftCorner<2, 2>().inverse();
    const Vec3& first = measured_.points.front();
    double height = 0;  // in the axes of the map
    Vec2 own = Vec2::Zero();
    for (int step = 0; step < map_steps; ++step) {
        own = plan * (place - pose_.shift.head<2>() - height * pose_.turn.col(2).head<2>());
        const Vec2 cells = (own - first.head<2>()).cwiseQuotient(measured_.spacing);
        height = map_height(cells.x(), cells.y());
        if (!std::isfinite(height)) return missing<double>;
    }
    return pose_(Vec3(own.x(), own.y(), height)).z();
}

}  // namespace clsurf
