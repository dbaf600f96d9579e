#pragma once
// Derivatives of quantised positions: Savitzky–Golay, a least-squares polynomial over a window of about 20 ms
// (Savitzky, Golay 1964). Exact on polynomials of its order, without phase lag. Near the ends of a section the window
// stays inside it, and the polynomial is evaluated off centre.

#include <span>
#include <vector>

#include "core/point.h"

namespace clsurf {

struct DerivativeFilter {
    int points = 21;     ///< of the window, odd
    int order = 2;       ///< of the polynomial
    int derivative = 1;  ///< 1, 2, 3; 0: the smoothed value itself
    double period = 0;   ///< [s]

    /// The greatest error of the derivative if a position is rounded to another step within the window, per mm of step
    /// [1/s^d].
    [[nodiscard]] double step_response() const;
    /// The greatest derivative that an abrupt change of speed gives, per mm/s of change [1/s^(d−1)].
    [[nodiscard]] double speed_step_response() const;
    /// Frequency at which the filter gives 1/√2 of the true derivative [Hz].
    [[nodiscard]] double bandwidth() const;
};

/// The filter for a derivative at this period: 20 ms, at least order + 2 points; third derivatives
/// 40 ms, since their noise grows with (1/window)^3.5.
[[nodiscard]] DerivativeFilter derivative_filter(int derivative, double period);

/// The same with the window time that a log with the period `coarsest` [s] needs: derivatives of logs with different
/// periods can then be compared.
[[nodiscard]] DerivativeFilter derivative_filter(int derivative, double period, double coarsest);

/// Weights of the window's points for the value at its point `at`, 0 … points − 1. Per period^d. Domain: points > order.
[[nodiscard]] std::vector<double> derivative_weights(int points, int order, int derivative, int at);

/// The weights of a filter, computed once for all positions in the window.
class Differentiator {
public:
    explicit Differentiator(const DerivativeFilter& filter);

    [[nodiscard]] const DerivativeFilter& filter() const { return filter_; }
    /// How many points beyond a section are read.
    [[nodiscard]] PointIndex reach() const { return filter_.points; }

    /// Derivatives of points [first, first + out.size()) of a piece. `samples` has the piece's points from
    /// `samples_first` on, at least `reach()` beyond both ends of the section or to the piece's ends. A piece with
    /// fewer points than the window is fitted as a whole; with fewer than order + 1 its derivatives are NaN. Units:
    /// samples' unit / s^d.
    void apply(std::span<const double> samples, PointIndex samples_first, PointRange piece, PointIndex first,
               std::span<double> out) const;

private:
    DerivativeFilter filter_;
    std::vector<std::vector<double>> weights_;  ///< by position in the window, divided by period^d
};

}  // namespace clsurf
