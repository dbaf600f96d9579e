#include "machined/fold.h"

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace clsurf {
namespace {

using Terms = LocalQuadratic::Terms;

constexpr std::array crease_offsets{-1.6, -0.8, 0.0, 0.8, 1.6};  ///< offsets of the first crease from the knot
constexpr int lloyd_rounds = 4;              ///< rounds of Lloyd's iteration, which usually converges in two or three
constexpr std::size_t fewest_on_sheet = 12;  ///< places per sheet; two for each term of a quadratic
constexpr double most_counted = 8;  ///< times `most`: larger distances count as this; a third sheet must not decide

/// The quadratic through the places of one side.
template <typename Belongs>
std::optional<Terms> fit_sheet(std::span<const WeighedPlace> places, double least_spread, LocalQuadratic& quadratic,
                               Belongs&& belongs) {
    quadratic.clear();
    for (const WeighedPlace& p : places) {
        if (belongs(p)) quadratic.add(p.x, p.y, p.z, p.weight);
    }
    if (quadratic.size() < fewest_on_sheet) return std::nullopt;
    Terms fitted = quadratic.fit(least_spread);
    if (!fitted.allFinite()) return std::nullopt;
    return fitted;
}

template <typename IsOne>
std::optional<Fold> fit_two_sheets(std::span<const WeighedPlace> places, bool ridge, double least_spread,
                                   LocalQuadratic& quadratic, IsOne&& is_one) {
    const std::optional<Terms> one = fit_sheet(places, least_spread, quadratic, is_one);
    if (!one) return std::nullopt;
    const std::optional<Terms> two =
        fit_sheet(places, least_spread, quadratic, [&](const WeighedPlace& p) { return !is_one(p); });
    if (!two) return std::nullopt;
    return Fold{*one, *two, ridge};
}

double fold_cost(const Fold& fold, std::span<const WeighedPlace> places, double most) {
    double cost = 0;
    for (const WeighedPlace& p : places)
        cost += p.weight * std::min(std::abs(p.z - fold.at(p.x, p.y)), most_counted * most);
    return cost;
}

}  // namespace

double value_of(const Terms& a, double x, double y) {
    return a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y;
}

bool Fold::is_on_one(double x, double y) const {
    const double a = value_of(one, x, y);
    const double b = value_of(two, x, y);
    return ridge ? a <= b : a >= b;
}

double Fold::at(double x, double y) const { return value_of(is_on_one(x, y) ? one : two, x, y); }

std::optional<Fold> fit_fold(std::span<const WeighedPlace> places, const Terms& smooth, double most,
                             double least_spread, LocalQuadratic& quadratic) {
    Eigen::Matrix2d bend;
    bend << 2 * smooth[3], smooth[4], smooth[4], 2 * smooth[5];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> bends(bend);
    const int sharpest = std::abs(bends.eigenvalues()[0]) > std::abs(bends.eigenvalues()[1]) ? 0 : 1;
    const bool ridge = bends.eigenvalues()[sharpest] < 0;
    const Eigen::Vector2d across = bends.eigenvectors().col(sharpest);
    std::optional<Fold> best;
    double least = std::numeric_limits<double>::infinity();
    const auto keep_better = [&](const std::optional<Fold>& fold) {
        const double cost = fold ? fold_cost(*fold, places, most) : least;
        if (!(cost < least)) return false;
        least = cost;
        best = fold;
        return true;
    };
    for (const double offset : crease_offsets) {
        keep_better(fit_two_sheets(places, ridge, least_spread, quadratic, [&](const WeighedPlace& p) {
            return across.x() * p.x + across.y() * p.y < offset;
        }));
    }
    for (int round = 0; best && round < lloyd_rounds; ++round) {
        const Fold before = *best;
        if (!keep_better(fit_two_sheets(places, ridge, least_spread, quadratic,
                                        [&](const WeighedPlace& p) { return before.is_on_one(p.x, p.y); })))
            break;
    }
    return best;
}

}  // namespace clsurf
