#include "numeric/tube.h"

#include <array>

#include "numeric/banded_ldlt.h"

namespace clsurf {
namespace {

constexpr std::size_t width = 3;         ///< diagonals to each side
constexpr double penalty = 0.1;          ///< weight of leaving the tube, against squared third differences
constexpr double over_relaxation = 1.6;  ///< between 1.5 and 1.8: Boyd et al. 2011, 3.4.3
constexpr int rounds = 60;

/// A symmetric matrix by its diagonals (banded_ldlt.h).
using Banded = std::array<std::vector<double>, width + 1>;

BandedDiagonals<width> diagonals_of(Banded& m) { return {m[0], m[1], m[2], m[3]}; }

/// The sum of outer products of third divided differences, scaled by the mean spacing of the points.
Banded third_differences(std::span<const double> arc_lengths) {
    const std::size_t n = arc_lengths.size();
    const double spacing = (arc_lengths.back() - arc_lengths.front()) / static_cast<double>(n - 1);
    Banded sum;
    sum.fill(std::vector<double>(n));
    for (std::size_t k = 0; k + width < n; ++k) {
        std::array<double, width + 1> row{};
        for (std::size_t i = 0; i <= width; ++i) {
            row[i] = 6;
            for (std::size_t j = 0; j <= width; ++j)
                row[i] *= j == i ? 1 : spacing / (arc_lengths[k + i] - arc_lengths[k + j]);
        }
        for (std::size_t i = 0; i <= width; ++i) {
            for (std::size_t j = 0; j <= i; ++j) sum[i - j][k + j] += row[i] * row[j];
        }
    }
    return sum;
}

Vec3 held(const Vec3& p, const Vec3& place, double radius) {
    const Vec3 off = p - place;
    const double distance = off.norm();
    return distance > radius ? Vec3(place + off * (radius / distance)) : p;
}

}  // namespace

std::vector<Vec3> smoothest_in_tube(std::span<const Vec3> places, std::span<const double> arc_lengths,
                                    std::span<const double> radii, std::span<const Vec3> start) {
    const std::span<const Vec3> from = start.empty() ? places : start;
    std::vector<Vec3> inside(from.begin(), from.end());
    const std::size_t n = places.size();
    if (n <= width) return inside;
    for (std::size_t i = 0; i < n; ++i) inside[i] = held(inside[i], places[i], radii[i]);
    Banded matrix = third_differences(arc_lengths);
    for (double& element : matrix[0]) element += penalty;
    const BandedDiagonals<width> factors = diagonals_of(matrix);
    if (!factorise_banded<width>(factors)) return inside;  // never for increasing arc lengths: the penalty is positive
    std::vector<Vec3> smooth(n), owed(n, Vec3::Zero());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < n; ++i) smooth[i] = penalty * (inside[i] - owed[i]);
        solve_banded<width>(factors, std::span(smooth));
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 relaxed = over_relaxation * smooth[i] + (1 - over_relaxation) * inside[i];
            inside[i] = held(relaxed + owed[i], places[i], radii[i]);
            owed[i] += relaxed - inside[i];
        }
    }
    return inside;
}

}  // namespace clsurf
