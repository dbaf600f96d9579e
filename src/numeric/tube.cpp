#include "numeric/tube.h"

#include <array>

namespace clsurf {
namespace {

constexpr std::size_t width = 3;  ///< diagonals to each side
constexpr double penalty = 0.1;   ///< of leaving the tube, against squared third differences
constexpr double over_relaxation = 1.6;
constexpr int rounds = 60;

/// A symmetric matrix by its diagonals: row i has the elements (i, i) … (i, i − width).
using Banded = std::vector<std::array<double, width + 1>>;

/// The sum of outer products of third divided differences, as differences of points that lie the mean spacing apart.
Banded third_differences(std::span<const double> arc_lengths) {
    const std::size_t n = arc_lengths.size();
    const double spacing = (arc_lengths.back() - arc_lengths.front()) / static_cast<double>(n - 1);
    Banded sum(n, std::array<double, width + 1>{});
    for (std::size_t k = 0; k + width < n; ++k) {
        std::array<double, width + 1> row{};
        for (std::size_t i = 0; i <= width; ++i) {
            row[i] = 6;
            for (std::size_t j = 0; j <= width; ++j)
                row[i] *= j == i ? 1 : spacing / (arc_lengths[k + i] - arc_lengths[k + j]);
        }
        for (std::size_t i = 0; i <= width; ++i) {
            for (std::size_t j = 0; j <= i; ++j) sum[k + i][i - j] += row[i] * row[j];
        }
    }
    return sum;
}

/// L D Lᵀ in place: the first column is D, the others L.
void factorise(Banded& m) {
    for (std::size_t i = 0; i < m.size(); ++i) {
        for (std::size_t back = std::min(i, width); back > 0; --back) {
            const std::size_t j = i - back;
            double value = m[i][back];
            for (std::size_t k = i > width ? i - width : 0; k < j; ++k) {
                if (j - k <= width) value -= m[i][i - k] * m[k][0] * m[j][j - k];
            }
            m[i][back] = value / m[j][0];
        }
        for (std::size_t back = 1; back <= std::min(i, width); ++back)
            m[i][0] -= m[i][back] * m[i][back] * m[i - back][0];
    }
}

void solve(const Banded& m, std::vector<Vec3>& x) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t back = 1; back <= std::min(i, width); ++back) x[i] -= m[i][back] * x[i - back];
    }
    for (std::size_t i = x.size(); i-- > 0;) {
        x[i] /= m[i][0];
        for (std::size_t on = 1; on <= width && i + on < x.size(); ++on) x[i] -= m[i + on][on] * x[i + on];
    }
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
    for (auto& row : matrix) row[0] += penalty;
    factorise(matrix);
    std::vector<Vec3> smooth(n), owed(n, Vec3::Zero());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < n; ++i) smooth[i] = penalty * (inside[i] - owed[i]);
        solve(matrix, smooth);
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 relaxed = over_relaxation * smooth[i] + (1 - over_relaxation) * inside[i];
            inside[i] = held(relaxed + owed[i], places[i], radii[i]);
            owed[i] += relaxed - inside[i];
        }
    }
    return inside;
}

}  // namespace clsurf
