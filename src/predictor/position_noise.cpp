#include "predictor/position_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr std::size_t records = 5;
constexpr std::array<double, records> fourth_difference{1, -4, 6, -4, 1};
// The squares 1² + 4² + 6² + 4² + 1² add up to 70.
constexpr double gain = 8.3666;              ///< √70: factor from independent errors to their fourth difference
constexpr double calm_share = 0.25;          ///< share of all fourth differences
constexpr double calm_deviation = 0.318639;  ///< standard deviations: a quarter of normal errors is smaller
constexpr PointIndex most_noise_samples = 20'000;
constexpr std::size_t fewest_samples = 100;

}  // namespace

double position_noise(const Trajectory& path, const std::vector<PointRange>& pieces) {
    const PointIndex stride = std::max<PointIndex>(1, path.count / most_noise_samples);
    std::array<std::array<double, records>, 3> p{};
    std::vector<float> differences;
    PointIndex next = 0;
    for (const PointRange& piece : pieces) {
        for (next = std::max(next, piece.first); next + static_cast<PointIndex>(records) - 1 <= piece.last;
             next += stride) {
            path.read(next, p[0], p[1], p[2]);
            Vec3 difference = Vec3::Zero(), feed;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<Eigen::Index>(axis);
                for (std::size_t k = 0; k < records; ++k) difference[a] += fourth_difference[k] * p[axis][k];
                feed[a] = p[axis].back() - p[axis].front();
            }
            const double along = std::abs(difference.dot(feed.normalized()));
            if (std::isfinite(along) && feed.norm() > 0) differences.push_back(static_cast<float>(along));
        }
    }
    if (differences.size() < fewest_samples) return 0;
    return static_cast<double>(quantile_below(differences, calm_share)) / (calm_deviation * gain);
}

}  // namespace clsurf
