#include "numeric/curvature_steps.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clsurf {
namespace {

constexpr double well_resolved = 400;    ///< curvature · distance² that resolves a step well, in steps of coordinates
constexpr double most_turn = 0.5;        ///< [rad] greatest turn over which an arc is nearly a parabola
constexpr std::size_t least_points = 4;  ///< on each side
constexpr std::size_t usual_points = 6;
constexpr std::size_t most_fitted = 32;  ///< points on each side for the parabolas
constexpr double much_less = 0.5;        ///< share of the squared residuals of a cubic
constexpr double parabola = 0.004;       ///< deviation of an arc from a parabola, relative to its height
constexpr double rounding = 0.6;         ///< steps of the coordinates: a larger rms is not rounding alone

/// Heights of points over the chord of a section, in the direction in which it bends, by arc length from its middle.
struct BentSection {
    std::vector<double> u, y;
    std::vector<std::size_t> index;
};

/// The sum of squared residuals after fitting 1, u, u² and a fourth function.
template <typename F>
double residual_after(const BentSection& section, F&& fourth) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0;
    for (std::size_t k = 0; k < section.u.size(); ++k) {
        const double u = section.u[k];
        const Eigen::Vector4d terms(1, u, u * u, fourth(u));
        normal += terms * terms.transpose();
        right += section.y[k] * terms;
        squares += section.y[k] * section.y[k];
    }
    return std::max(0.0, squares - right.dot(normal.ldlt().solve(right)));
}

/// The index at `distance` [mm] along the path from a point, between least and most points away and not beyond a
/// bound.
std::size_t reached(std::span<const Vec3> points, std::size_t from, std::size_t bound, double distance) {
    std::size_t i = from, passed = 0;
    for (double way = 0; i != bound; ++passed) {
        const std::size_t next = bound > from ? i + 1 : i - 1;
        way += (points[next] - points[i]).norm();
        if (way > distance && passed >= least_points) break;
        i = next;
    }
    return i;
}

double greatest_between(std::span<const double> values, std::size_t first, std::size_t last) {
    double greatest = 0;
    for (std::size_t i = first; i <= last; ++i)
        if (std::isfinite(values[i])) greatest = std::max(greatest, values[i]);
    return greatest;
}

BentSection bent_section(std::span<const Vec3> points, std::size_t first, std::size_t last) {
    BentSection section;
    const Vec3 chord = points[last] - points[first];
    Vec3 bend = Vec3::Zero();
    for (std::size_t i = first; i <= last; ++i) {
        const Vec3 off = points[i] - points[first];
        bend += off - chord * (off.dot(chord) / chord.squaredNorm());
    }
    if (!(bend.norm() > 0)) return section;
    bend.normalize();
    const std::size_t stride = 1 + (last - first) / (2 * most_fitted);
    std::vector<double> way{0};
    for (std::size_t i = first + 1; i <= last; ++i) way.push_back(way.back() + (points[i] - points[i - 1]).norm());
    const double scale = 0.5 * way.back();
    const auto add = [&](std::size_t i) {
        section.index.push_back(i);
        section.u.push_back(way[i - first] / scale - 1);
        section.y.push_back((points[i] - points[first]).dot(bend));
    };
    for (std::size_t i = first; i <= last; i += stride) add(i);
    return section;
}

}  // namespace

std::optional<std::size_t> curvature_step_near(std::span<const Vec3> points, std::span<const double> curvature,
                                               std::size_t boundary, std::size_t first, std::size_t last, double step) {
    const auto reach_of = [&](double bend) { return std::sqrt(well_resolved * step / bend); };
    if (!(curvature[boundary] > 0) || !std::isfinite(curvature[boundary])) return {};
    const double wide = reach_of(curvature[boundary]);
    const double bend =
        greatest_between(curvature, reached(points, boundary, first, wide), reached(points, boundary, last, wide));
    const double block = 0.5 * (points[boundary + 1] - points[boundary - 1]).norm();
    const double reach =
        std::min(std::max(reach_of(bend), static_cast<double>(usual_points) * block), most_turn / bend);
    const std::size_t low = reached(points, boundary, first, reach), high = reached(points, boundary, last, reach);
    if (boundary - low < least_points || high - boundary < least_points) return {};
    const BentSection section = bent_section(points, low, high);
    if (section.u.empty()) return {};
    const double may_leave = std::max(rounding * step, parabola * 0.5 * bend * reach * reach);
    const double of_rounding = may_leave * may_leave * static_cast<double>(section.u.size());
    double least = std::min(of_rounding, much_less * residual_after(section, [](double u) { return u * u * u; }));
    std::optional<std::size_t> result;
    for (std::size_t k = 2; k + 2 < section.u.size(); ++k) {
        const double left = residual_after(section, [at = section.u[k]](double u) {
            const double beyond = std::max(0.0, u - at);
            return beyond * beyond;
        });
        if (left < least) least = left, result = section.index[k];
    }
    return result;
}

}  // namespace clsurf
