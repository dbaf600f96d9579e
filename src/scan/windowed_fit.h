#pragma once
// WindowedFit: least-squares polynomials z(x) of windows of scanned points, as one curve.
//
// Each polynomial is in Bernstein form over its own piece, so the equations are well conditioned for any position of the
// points: in powers of x the normal matrix of a cubic of ten points about x = 2150 mm has a condition of 3·10³¹.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace clsurf {

/// How the polynomials of adjacent windows are joined.
enum class WindowJoin : std::uint8_t {
    c1,     ///< one least-squares fit with continuous value and slope
    blend,  ///< windows overlap by half; each is blended into the next with 3 q² − 2 q³
    none,   ///< independent: the curve jumps halfway between two windows
};

inline constexpr int most_fit_degree = 9;

struct FitRules {
    int degree = 3;           ///< 1 … most_fit_degree; at least 2 with c1
    std::size_t window = 10;  ///< points, at least degree + 1
    WindowJoin join = WindowJoin::c1;
};

/// Height, slope and second derivative with respect to x.
struct FitJet {
    double z = 0, slope = 0, second = 0;
};

/// A polynomial over a piece of x.
struct FitPiece {
    double begin = 0, end = 0;      ///< [mm]
    std::vector<double> ordinates;  ///< [mm] Bernstein coefficients: degree + 1

    [[nodiscard]] FitJet jet(double x) const;
    [[nodiscard]] double at(double x) const { return jet(x).z; }
    /// The same polynomial over another piece.
    [[nodiscard]] FitPiece over(double from, double to) const;
};

/// The step between two pieces: the right one minus the left one.
struct PieceStep {
    double x = 0, z = 0, slope = 0;
};

struct WindowedFit {
    std::vector<FitPiece> pieces;  ///< adjoining, in ascending x

    [[nodiscard]] const FitPiece& piece_at(double x) const;
    [[nodiscard]] double at(double x) const { return piece_at(x).at(x); }
    /// One entry for each joint of two pieces.
    [[nodiscard]] std::vector<PieceStep> steps() const;
};

/// Domain: x strictly increasing, as many z, at least degree + 1 points, rules as in FitRules. A last window of fewer than
/// degree + 1 points: with c1 it is merged into the previous one; else its polynomial is that of the last `window` points.
/// O(points degree²).
[[nodiscard]] WindowedFit fit_windows(std::span<const double> x, std::span<const double> z, const FitRules& rules);

}  // namespace clsurf
