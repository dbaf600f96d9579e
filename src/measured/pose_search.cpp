#include "measured/pose_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace clsurf {
namespace {

constexpr std::size_t best_minima = 6;
constexpr double searched_share = 0.8;  ///< share of the points

}  // namespace

std::vector<Pose> PoseSearch::around(const Pose& middle, double step, std::int64_t steps) {
    const std::int64_t wide = is_free(PoseAxis::x) ? steps : 0;
    const std::int64_t high = is_free(PoseAxis::y) ? steps : 0;
    const std::int64_t columns = 2 * wide + 1;
    std::vector<Vec2> places(points_.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = middle(points_[i]).head<2>();
    heights_.prepare(places, step * static_cast<double>(steps + 1));
    const auto shifted = [&](std::int64_t column, std::int64_t row) {
        const Vec3 by = step * (static_cast<double>(column) * axes_.col(0) + static_cast<double>(row) * axes_.col(1));
        return Pose{middle.turn, middle.shift + by};
    };
    std::vector<Squares> grid;
    for (std::int64_t row = -high; row <= high; ++row) {
        for (std::int64_t column = -wide; column <= wide; ++column) grid.push_back(levelled(shifted(column, row)));
    }
    std::vector<Pose> found;
    for (const auto of : {&Squares::all, &Squares::nearest}) {
        const auto at = [&](std::int64_t column, std::int64_t row) {
            if (std::abs(column) > wide || std::abs(row) > high) return infinite_square;
            return grid[static_cast<std::size_t>((row + high) * columns + column + wide)].*of;
        };
        std::vector<std::pair<double, Pose>> minima;
        for (std::int64_t row = -high; row <= high; ++row) {
            for (std::int64_t column = -wide; column <= wide; ++column) {
                const double here = at(column, row);
                bool least = here < infinite_square;
                for (std::int64_t r = row - 1; r <= row + 1; ++r) {
                    for (std::int64_t c = column - 1; c <= column + 1; ++c) least = least && here <= at(c, r);
                }
                if (least) minima.emplace_back(here, shifted(column, row));
            }
        }
        std::stable_sort(minima.begin(), minima.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::size_t k = 0; k < std::min(minima.size(), best_minima); ++k) found.push_back(minima[k].second);
    }
    return found;
}

PoseSearch::Squares PoseSearch::levelled(const Pose& pose) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vec3 right = Vec3::Zero();
    std::vector<std::pair<double, Vec3>> off;  // height above the surface, and its derivatives
    off.reserve(points_.size());
    const Vec3 middle = pose(points_[points_.size() / 2]);
    for (const Vec3& point : points_) {
        const Vec3 p = pose(point);
        const double height = p.z() - heights_.at(p.head<2>());
        if (!std::isfinite(height)) continue;
        const Vec3 from = axes_.transpose() * (p - middle);
        const Vec3 row(is_free(PoseAxis::z) ? 1 : 0, is_free(PoseAxis::b) ? from.x() : 0,
                       is_free(PoseAxis::a) ? from.y() : 0);
        normal += row * row.transpose();
        right += height * row;
        off.emplace_back(height, row);
    }
    if (10 * off.size() < 9 * points_.size()) return {};
    normal.diagonal().array() += 1e-12 * (1 + normal.trace());
    const Vec3 level = normal.ldlt().solve(right);
    std::vector<double> squares;
    squares.reserve(off.size());
    for (const auto& [height, row] : off) squares.push_back(std::pow(height - level.dot(row), 2));
    const auto nearest = static_cast<std::ptrdiff_t>(searched_share * static_cast<double>(squares.size()));
    std::nth_element(squares.begin(), squares.begin() + nearest, squares.end());
    Squares result{0, 0};
    for (std::size_t k = 0; k < squares.size(); ++k) {
        result.all += squares[k] / static_cast<double>(squares.size());
        if (static_cast<std::ptrdiff_t>(k) < nearest) result.nearest += squares[k] / static_cast<double>(nearest);
    }
    return result;
}

}  // namespace clsurf
