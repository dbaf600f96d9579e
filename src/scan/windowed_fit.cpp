#include "scan/windowed_fit.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace clsurf {
namespace {

constexpr std::size_t blend_degree = 3;
constexpr std::size_t most_ordinates = static_cast<std::size_t>(most_fit_degree) + blend_degree + 1;
using Ordinates = std::array<double, most_ordinates>;

/// Bernstein's polynomials of a degree at t.
Ordinates bernstein(std::size_t degree, double t) {
    Ordinates values{};
    values[0] = 1;
    for (std::size_t d = 1; d <= degree; ++d) {
        for (std::size_t k = d; k > 0; --k) values[k] = (1 - t) * values[k] + t * values[k - 1];
        values[0] *= 1 - t;
    }
    return values;
}

/// The least-squares polynomial of some points, over the piece that they span.
FitPiece polynomial_of(std::span<const double> x, std::span<const double> z, std::size_t degree) {
    FitPiece piece{x.front(), x.back(), {}};
    const auto rows = static_cast<Eigen::Index>(x.size());
    Eigen::MatrixXd matrix(rows, static_cast<Eigen::Index>(degree + 1));
    for (Eigen::Index i = 0; i < rows; ++i) {
        const double t = (x[static_cast<std::size_t>(i)] - piece.begin) / (piece.end - piece.begin);
        const Ordinates row = bernstein(degree, t);
        for (std::size_t k = 0; k <= degree; ++k) matrix(i, static_cast<Eigen::Index>(k)) = row[k];
    }
    const Eigen::VectorXd found =
        matrix.householderQr().solve(Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())));
    piece.ordinates.assign(found.begin(), found.end());
    return piece;
}

/// a (1 − w) + b w over the piece of the transition, w = 3 q² − 2 q³.
FitPiece blended(const FitPiece& left, const FitPiece& right, double from, double to) {
    const std::vector<double> a = left.over(from, to).ordinates, b = right.over(from, to).ordinates;
    const std::size_t degree = a.size() - 1;
    const std::size_t high = degree + blend_degree;
    constexpr std::array<double, blend_degree + 1> weight{0, 0, 1, 1};  // of 3 q² − 2 q³
    const auto binomial = [](std::size_t n, std::size_t k) {
        double value = 1;
        for (std::size_t i = 1; i <= k; ++i) value *= static_cast<double>(n - k + i) / static_cast<double>(i);
        return value;
    };
    FitPiece piece{from, to, std::vector<double>(high + 1)};
    for (std::size_t i = 0; i <= degree; ++i) {
        for (std::size_t k = 0; k <= blend_degree; ++k) {
            const double share = binomial(degree, i) * binomial(blend_degree, k) / binomial(high, i + k);
            piece.ordinates[i + k] += share * (a[i] + weight[k] * (b[i] - a[i]));
        }
    }
    return piece;
}

/// The first points of consecutive windows; a last window with too few points is merged into the previous one.
std::vector<std::size_t> window_starts(std::size_t points, std::size_t window, std::size_t fewest) {
    std::vector<std::size_t> starts{0};
    while (starts.back() + window < points && points - (starts.back() + window) >= fewest)
        starts.push_back(starts.back() + window);
    return starts;
}

WindowedFit fit_apart(std::span<const double> x, std::span<const double> z, std::size_t degree, std::size_t window) {
    WindowedFit fit;
    for (std::size_t first = 0; first < x.size(); first += window) {
        const std::size_t end = std::min(first + window, x.size());
        std::size_t from = first;
        if (end - first < degree + 1) from = x.size() - std::min(window, x.size());
        const double begin = first == 0 ? x.front() : 0.5 * (x[first - 1] + x[first]);
        const double last = end == x.size() ? x.back() : 0.5 * (x[end - 1] + x[end]);
        fit.pieces.push_back(
            polynomial_of(x.subspan(from, end - from), z.subspan(from, end - from), degree).over(begin, last));
    }
    return fit;
}

WindowedFit fit_blended(std::span<const double> x, std::span<const double> z, std::size_t degree, std::size_t window) {
    std::vector<FitPiece> windows;
    const std::size_t step = std::max<std::size_t>(1, window / 2);
    for (std::size_t first = 0;; first += step) {
        const bool last = first + window >= x.size();
        const std::size_t count = std::min(window, x.size());
        if (last) first = x.size() - count;
        windows.push_back(polynomial_of(x.subspan(first, count), z.subspan(first, count), degree));
        if (last) break;
    }
    WindowedFit fit;
    double at = x.front();
    for (std::size_t k = 0; k < windows.size(); ++k) {
        const bool last = k + 1 == windows.size();
        const double next = last ? x.back() : std::max(at, windows[k + 1].begin);
        if (next > at) fit.pieces.push_back(windows[k].over(at, next));
        if (last) break;
        at = windows[k].end;
        fit.pieces.push_back(blended(windows[k], windows[k + 1], next, at));
    }
    return fit;
}

/// The least-squares polynomials with continuous value and slope. The inner ordinates are free, and so are the first and
/// the last of all; the ordinate at a joint of two pieces divides the line between its neighbours in the ratio of their
/// lengths (Farin, Curves and Surfaces for CAGD, 5th ed., section 5.5).
class ContinuousFit {
public:
    ContinuousFit(std::span<const double> x, std::span<const double> z, std::size_t degree, std::size_t window)
        : x_(x), z_(z), degree_(degree), starts_(window_starts(x.size(), window, degree + 1)) {}

    [[nodiscard]] WindowedFit solve() const {
        const std::size_t unknowns = starts_.size() * (degree_ - 1) + 2;
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t k = 0; k < starts_.size(); ++k) {
            const std::size_t end = k + 1 < starts_.size() ? starts_[k + 1] : x_.size();
            for (std::size_t i = starts_[k]; i < end; ++i) {
                const Ordinates row = row_of(k, (x_[i] - begin_of(k)) / length_of(k));
                for (std::size_t j = 0; j <= degree_; ++j)
                    entries.emplace_back(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(first_of(k) + j),
                                         row[j]);
            }
        }
        Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(x_.size()), static_cast<Eigen::Index>(unknowns));
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SparseMatrix<double> normal = matrix.transpose() * matrix;
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> solver(
            normal);
        const Eigen::Map<const Eigen::VectorXd> heights(z_.data(), static_cast<Eigen::Index>(z_.size()));
        Eigen::VectorXd found = solver.solve(matrix.transpose() * heights);
        // The normal equations square the condition; one refinement by the residual restores the digits.
        found += solver.solve(matrix.transpose() * (heights - matrix * found));
        WindowedFit fit;
        for (std::size_t k = 0; k < starts_.size(); ++k) fit.pieces.push_back(piece_of(k, found));
        return fit;
    }

private:
    [[nodiscard]] double begin_of(std::size_t k) const { return x_[starts_[k]]; }
    [[nodiscard]] double length_of(std::size_t k) const {
        return (k + 1 < starts_.size() ? begin_of(k + 1) : x_.back()) - begin_of(k);
    }
    /// The first of degree + 1 unknowns that shape piece k.
    [[nodiscard]] std::size_t first_of(std::size_t k) const { return k * (degree_ - 1); }
    /// Weight of the unknown on the left in the ordinate before piece k; the one on the right has the rest.
    [[nodiscard]] double left_share(std::size_t k) const {
        if (k == 0) return 1;
        if (k == starts_.size()) return 0;
        return length_of(k) / (length_of(k - 1) + length_of(k));
    }
    /// Coefficients of the unknowns at t of piece k.
    [[nodiscard]] Ordinates row_of(std::size_t k, double t) const {
        Ordinates row = bernstein(degree_, t);
        const double left = left_share(k), right = left_share(k + 1);
        const double first = row[0], last = row[degree_];
        row[0] = first * left;
        row[1] += first * (1 - left);
        row[degree_ - 1] += last * right;
        row[degree_] = last * (1 - right);
        return row;
    }
    [[nodiscard]] FitPiece piece_of(std::size_t k, const Eigen::VectorXd& found) const {
        const auto unknown = [&](std::size_t j) { return found[static_cast<Eigen::Index>(first_of(k) + j)]; };
        FitPiece piece{begin_of(k), begin_of(k) + length_of(k), std::vector<double>(degree_ + 1)};
        for (std::size_t j = 1; j < degree_; ++j) piece.ordinates[j] = unknown(j);
        const double left = left_share(k), right = left_share(k + 1);
        piece.ordinates[0] = left * unknown(0) + (1 - left) * unknown(1);
        piece.ordinates[degree_] = right * unknown(degree_ - 1) + (1 - right) * unknown(degree_);
        if (k + 1 < starts_.size()) piece.end = begin_of(k + 1);
        return piece;
    }

    std::span<const double> x_, z_;
    std::size_t degree_;
    std::vector<std::size_t> starts_;
};

}  // namespace

FitJet FitPiece::jet(double x) const {
    const std::size_t degree = ordinates.size() - 1;
    const double length = end - begin;
    const double t = (x - begin) / length;
    Ordinates b{};
    std::copy(ordinates.begin(), ordinates.end(), b.begin());
    const auto n = static_cast<double>(degree);
    FitJet jet;
    for (std::size_t d = degree; d > 0; --d) {
        if (d == 2) jet.second = n * (n - 1) * (b[2] - 2 * b[1] + b[0]) / (length * length);
        if (d == 1) jet.slope = n * (b[1] - b[0]) / length;
        for (std::size_t k = 0; k < d; ++k) b[k] += t * (b[k + 1] - b[k]);
    }
    jet.z = b[0];
    return jet;
}

FitPiece FitPiece::over(double from, double to) const {
    const std::size_t degree = ordinates.size() - 1;
    const double u = (from - begin) / (end - begin), v = (to - begin) / (end - begin);
    FitPiece piece{from, to, std::vector<double>(degree + 1)};
    for (std::size_t j = 0; j <= degree; ++j) {
        // The blossom at degree − j times u and j times v.
        std::vector<double> b = ordinates;
        for (std::size_t d = degree; d > 0; --d) {
            const double t = d > j ? u : v;
            for (std::size_t k = 0; k < d; ++k) b[k] += t * (b[k + 1] - b[k]);
        }
        piece.ordinates[j] = b[0];
    }
    return piece;
}

const FitPiece& WindowedFit::piece_at(double x) const {
    const auto after = std::upper_bound(pieces.begin(), pieces.end(), x,
                                        [](double value, const FitPiece& piece) { return value < piece.begin; });
    return after == pieces.begin() ? pieces.front() : *(after - 1);
}

std::vector<PieceStep> WindowedFit::steps() const {
    std::vector<PieceStep> steps;
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        const double x = pieces[k].begin;
        const FitJet left = pieces[k - 1].jet(x), right = pieces[k].jet(x);
        steps.push_back({x, right.z - left.z, right.slope - left.slope});
    }
    return steps;
}

WindowedFit fit_windows(std::span<const double> x, std::span<const double> z, const FitRules& rules) {
    const auto degree = static_cast<std::size_t>(rules.degree);
    switch (rules.join) {
        case WindowJoin::blend: return fit_blended(x, z, degree, rules.window);
        case WindowJoin::none: return fit_apart(x, z, degree, rules.window);
        case WindowJoin::c1: break;
    }
    return ContinuousFit(x, z, degree, rules.window).solve();
}

}  // namespace clsurf
