#include "numeric/least_squares.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/SparseCholesky>

namespace clsurf {
namespace {

/// Weights of value, derivative, value and derivative at the ends of a piece of length h, at fraction q of it.
std::array<double, 4> weights(double q, double h) {
    const double p = 1 - q;
    return {p * p * (1 + 2 * q), h * q * p * p, q * q * (1 + 2 * p), -h * p * q * q};
}

/// The part of a cubic that begins at `from` and has this length.
CubicSpan part(const CubicSpan& curve, double from, double length) {
    const std::array<Vec3, 4>& c = curve.coefficients;
    return {{curve.at(from), curve.derivative(from), c[2] + 3 * from * c[3], c[3]}, length};
}

}  // namespace

HermiteFit fit_hermite(std::span<const double> at, std::span<const Vec3> points, std::span<const double> breaks,
                       FitEnds ends) {
    // Unknowns at each break: value, and derivative times the length of the next piece, which is of similar size.
    const std::size_t knots = breaks.size();
    const auto unknowns = static_cast<Eigen::Index>(2 * knots);
    const auto scale = [&](std::size_t k) {
        return k + 1 < knots ? breaks[k + 1] - breaks[k] : breaks[k] - breaks[k - 1];
    };
    const auto pinned = [&](Eigen::Index i) { return ends == FitEnds::pinned && (i == 0 || i == unknowns - 2); };
    const auto pin = [&](Eigen::Index i) -> const Vec3& { return i == 0 ? points.front() : points.back(); };
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(unknowns, 3);
    std::size_t k = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        while (k + 2 < knots && at[i] >= breaks[k + 1]) ++k;
        const double h = breaks[k + 1] - breaks[k];
        std::array<double, 4> w = weights((at[i] - breaks[k]) / h, h);
        w[1] /= scale(k);
        w[3] /= scale(k + 1);
        const auto first = static_cast<Eigen::Index>(2 * k);
        Vec3 target = points[i];
        for (Eigen::Index a = 0; a < 4; ++a) {
            if (pinned(first + a)) target -= w[static_cast<std::size_t>(a)] * pin(first + a);
        }
        for (Eigen::Index a = 0; a < 4; ++a) {
            if (pinned(first + a)) continue;
            right.row(first + a) += w[static_cast<std::size_t>(a)] * target.transpose();
            for (Eigen::Index b = 0; b <= a; ++b) {
                if (!pinned(first + b))
                    entries.emplace_back(first + a, first + b,
                                         w[static_cast<std::size_t>(a)] * w[static_cast<std::size_t>(b)]);
            }
        }
    }
    for (Eigen::Index i = 0; i < unknowns; ++i) {
        if (!pinned(i)) continue;
        entries.emplace_back(i, i, 1.0);
        right.row(i) = pin(i).transpose();
    }
    Eigen::SparseMatrix<double> normal(unknowns, unknowns);
    normal.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> solver(normal);
    const Eigen::MatrixX3d found = solver.solve(right);
    HermiteFit fit;
    fit.breaks.assign(breaks.begin(), breaks.end());
    for (std::size_t n = 0; n < knots; ++n) {
        const auto row = static_cast<Eigen::Index>(2 * n);
        fit.values.emplace_back(found.row(row).transpose());
        fit.slopes.emplace_back(found.row(row + 1).transpose() / scale(n));
    }
    return fit;
}

std::vector<CubicSpan> least_squares_spans(std::span<const Vec3> points, std::size_t window) {
    std::vector<double> at{0};
    for (std::size_t i = 1; i < points.size(); ++i) at.push_back(at.back() + (points[i] - points[i - 1]).norm());
    // As many chords to every piece as possible, counted symmetrically from both ends.
    const std::size_t chords = points.size() - 1;
    std::size_t pieces = std::max<std::size_t>(1, chords / window);
    if (pieces % 2 == 0 && chords % 2 != 0) --pieces;  // an even number needs a knot in the middle of a chord
    std::vector<std::size_t> knots{0};
    for (std::size_t k = 1; k <= pieces; ++k) {
        const std::size_t mirrored = pieces - k;
        knots.push_back(2 * k <= pieces ? k * chords / pieces : chords - mirrored * chords / pieces);
    }
    std::vector<double> breaks;
    for (const std::size_t knot : knots) breaks.push_back(at[knot]);
    const HermiteFit fit = fit_hermite(at, points, breaks, FitEnds::pinned);
    std::vector<CubicSpan> spans;
    for (std::size_t k = 0; k < pieces; ++k) {
        const CubicSpan piece = fit.piece(k);
        for (std::size_t i = knots[k]; i < knots[k + 1]; ++i)
            spans.push_back(part(piece, at[i] - breaks[k], at[i + 1] - at[i]));
    }
    return spans;
}

}  // namespace clsurf
