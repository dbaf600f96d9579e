#pragma once
// FusedAxis: the position of an axis from its scale and from its motor's encoder.
//
// The scale measures the table, with noise n_s; the encoder the motor, with less noise n_e but off by a difference b of
// backlash, pitch error and heat: s = p + n_s, e = p + b + n_e. With the weight w = σ_s²/(σ_s² + σ_e²) the mean
// s + w (e − s) has the least noise, and this noise is independent of that of d = e − s. So d alone tells b: a Kalman smoother
// (numeric/kalman_smoother.h) estimates it, with its noise and its wandering measured in d. The fused position is
//
//     p̂ = s + w (d − b̂),
//
// the slow part of the scale and the fast part of the encoder (a complementary filter; Brown 1972, "Integrated navigation
// systems and Kalman filtering: a perspective"). Its errors are white noise of variance σ_s² σ_e²/(σ_s² + σ_e²), and
// w (b̂ − b), independent of it.
//
// At a reversal b jumps by the backlash. Where backlash is found, b is estimated between reversals only, and while the
// motor crosses the backlash the scale is used alone. The encoder is first shifted to the scale's records.
// A drive that yields is a spring, which the acceleration winds up. Where the difference follows the acceleration, that
// counts as noise of the encoder, and the scale the more.
//
// Rounding is white noise only where positions lie anywhere between two codes of the scale. Where an axis creeps, or always
// advances by the same part of a code, the rounding stays in b̂, and σ_b is widened by it.

#include <array>
#include <span>
#include <vector>

#include "toolpath/smoother_fit.h"

namespace clsurf {

/// Where a motor turns round: the last record before it does, and its direction until there.
struct Reversal {
    PointIndex at = 0;
    int direction = 0;  ///< +1, −1
};

/// Reversals of more than `threshold` [the unit of the positions] between points [range.first, range.last], in order.
/// NaN positions are skipped.
[[nodiscard]] std::vector<Reversal> find_reversals(std::span<const double> positions, PointRange range,
                                                   double threshold);

/// s + w (d − b̂) over consecutive points of both, where `difference` smooths d = encoder − scale. Without NaN.
/// `smoothed`, if it is not empty, has b̂ and its derivatives [mm/s^d] for each point.
void fuse(std::span<const double> scale, std::span<const double> encoder, const KalmanSmoother& difference,
          double weight, std::span<double> fused, std::span<std::array<double, 4>> smoothed = {});

/// Over how many records a settled estimate of a smoother is as good as a mean.
[[nodiscard]] PointIndex mean_records(const KalmanSmoother& smoother);

/// Tests on consecutive differences what `smoother` states of them: b̂ from every second record against means of those
/// between them, an eighth of mean_records() each. Appends squared errors in units of their variance, in which the standard deviation of
/// b̂ is multiplied by `factors`, one for each difference.
void hold_out(std::span<const double> differences, const KalmanSmoother& smoother, std::span<const double> factors,
              std::vector<double>& ratios);

struct FusedAxis {
    /// Of a position [mm]: noise, and what the drive yields.
    double scale_sigma = 0, encoder_sigma = 0;
    double lead = 0;      ///< records by which the encoder is ahead of the scale
    double yield = 0;     ///< rms of what the drive yields to the acceleration [mm]; 0: none is found
    double backlash = 0;  ///< [mm], negative where the table leads; 0: none is found
    double weight = 0;    ///< w; 0: the axis never moves, and the scale is used alone
    /// Standard deviation of w (b̂ − b) by derivative [mm/s^d], far from reversals, with white rounding.
    std::array<double, 4> remaining{};
    std::vector<double> positions;               ///< of every point [mm]
    std::array<std::vector<float>, 4> sigmas{};  ///< of w (b̂ − b) at every point; infinite: scale alone
    /// Squared errors of b̂ from every second record against the records between them, in units of their variance.
    std::vector<double> held_out;

    /// Of the mean of both [mm]: 1/σ² = 1/σ_s² + 1/σ_e².
    [[nodiscard]] double sigma() const;
};

/// What an axis is fused from. `pieces` have no gaps in time; `samples` are where noise and delay are measured.
struct AxisRecords {
    ChannelView scale, encoder;
    PointIndex count = 0;
    double period = 0;  ///< [s]
    std::vector<PointRange> pieces, samples;
};

/// O(points).
[[nodiscard]] FusedAxis fuse_axis(const AxisRecords& records, NoiseFitter& fitter);

}  // namespace clsurf
