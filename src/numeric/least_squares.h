#pragma once
// Least-squares fit by cubics in Hermite form: a curve with a continuous derivative that smooths scattered points.
// (Cubics fitted separately per window jump where they meet: by 1.9 σ on average for windows of ten points.) Each
// cubic has its own variable from 0 to 1, so the equations are well conditioned for every distribution of points.

#include <cstddef>
#include <span>
#include <vector>

#include "numeric/cubic_span.h"

namespace clsurf {

enum class FitEnds : unsigned char {
    free,
    pinned,  ///< the curve begins in the first point and ends in the last
};

/// Values and derivatives at the breaks; one cubic between neighbouring breaks.
struct HermiteFit {
    std::vector<double> breaks;
    std::vector<Vec3> values, slopes;

    /// The cubic from break k to the next, its variable 0 at break k.
    [[nodiscard]] CubicSpan piece(std::size_t k) const {
        return hermite(values[k], values[k + 1], slopes[k], slopes[k + 1], breaks[k + 1] - breaks[k]);
    }
};

/// The least-squares curve through points at increasing parameters `at`. Breaks increase from the first parameter to
/// the last; each piece needs as many points as it has unknowns of its own. O(points + breaks).
[[nodiscard]] HermiteFit fit_hermite(std::span<const double> at, std::span<const Vec3> points,
                                     std::span<const double> breaks, FitEnds ends);

/// A smoothing curve near points [mm] whose neighbours differ, over the length of their chords, ends pinned, one
/// cubic to about `window` chords: a span for each chord. Points in reverse give the same curve.
[[nodiscard]] std::vector<CubicSpan> least_squares_spans(std::span<const Vec3> points, std::size_t window);

}  // namespace clsurf
