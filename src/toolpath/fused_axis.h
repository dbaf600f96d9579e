#pragma once
// FusedAxis: the position of an axis from its scale and from its motor's encoder.
//
// The scale measures the table, with noise n_s. The encoder measures the motor, with less noise n_e, but it differs from
// the table by b (backlash, pitch error and heat): s = p + n_s, e = p + b + n_e. With the weight w = σ_s²/(σ_s² + σ_e²)
// the mean s + w (e − s) has the least noise, and this noise is independent of the noise of d = e − s. So b follows from d
// alone: a Kalman smoother (numeric/kalman_smoother.h) estimates it, with its noise and its wandering measured in d.
// The fused position is
//
//     p̂ = s + w (d − b̂),
//
// the slow part of the scale and the fast part of the encoder (a complementary filter; Brown 1972, "Integrated
// navigation systems and Kalman filtering: a perspective"). Its errors are white noise of variance
// σ_s² σ_e²/(σ_s² + σ_e²), and w (b̂ − b), independent of it.
//
// The encoder is first shifted to the scale's records. At a reversal b jumps by the backlash. If backlash is found, b is
// estimated between reversals only, and while the motor crosses the backlash the scale is used alone. A compliant drive
// is a spring that the acceleration deflects. If the difference follows the acceleration, this part counts as noise of
// the encoder, and the scale gets more weight.
//
// Rounding is white noise only if positions are spread evenly between two codes of the scale. If an axis creeps, or
// always advances by the same part of a code, the rounding stays in b̂, and σ_b is increased by it.

#include <array>
#include <span>
#include <vector>

#include "toolpath/smoother_fit.h"

namespace clsurf {

/// A reversal of a motor: the last record before it, and the direction until then.
struct Reversal {
    PointIndex at = 0;
    int direction = 0;  ///< +1, −1
};

/// Reversals of more than `threshold` [the unit of the positions] between points [range.first, range.last], in order.
/// NaN positions are skipped.
[[nodiscard]] std::vector<Reversal> find_reversals(std::span<const double> positions, PointRange range,
                                                   double threshold);

/// s + w (d − b̂) over consecutive points of both; `difference` smooths d = encoder − scale. No NaN allowed.
/// `smoothed`, if it is not empty, gets b̂ and its derivatives [mm/s^d] for each point.
void fuse(std::span<const double> scale, std::span<const double> encoder, const KalmanSmoother& difference,
          double weight, std::span<double> fused, std::span<std::array<double, 4>> smoothed = {});

/// The number of records whose mean is as good as a settled estimate of a smoother.
[[nodiscard]] PointIndex mean_records(const KalmanSmoother& smoother);

/// Tests the uncertainty that `smoother` states on consecutive differences: b̂ from every second record against means of
/// those between them, an eighth of mean_records() each. Appends squared errors in units of their variance; `factors`, one
/// for each difference, multiply the standard deviation of b̂.
void hold_out(std::span<const double> differences, const KalmanSmoother& smoother, std::span<const double> factors,
              std::vector<double>& ratios);

struct FusedAxis {
    /// Uncertainty of a position [mm]: noise, including the compliance of the drive.
    double scale_sigma = 0, encoder_sigma = 0;
    double lead = 0;      ///< records by which the encoder is ahead of the scale
    double yield = 0;     ///< rms of the drive's deflection by the acceleration [mm]; 0: none is found
    double backlash = 0;  ///< [mm], negative if the table leads; 0: none is found
    double weight = 0;    ///< w; 0: the axis never moves, and the scale is used alone
    /// Standard deviation of w (b̂ − b) by derivative [mm/s^d], far from reversals, with white rounding.
    std::array<double, 4> remaining{};
    std::vector<double> positions;               ///< of every point [mm]
    std::array<std::vector<float>, 4> sigmas{};  ///< of w (b̂ − b) at every point; infinite: scale alone
    /// Hold-out errors of b̂, from every second record against the records between them: squares in units of their
    /// variance.
    std::vector<double> held_out;

    /// Standard deviation of the mean of both [mm]: 1/σ² = 1/σ_s² + 1/σ_e².
    [[nodiscard]] double sigma() const;
};

/// Input of the fusion of an axis. `pieces` have no gaps in time; noise and delay are measured in `samples`.
struct AxisRecords {
    ChannelView scale, encoder;
    PointIndex count = 0;
    double period = 0;  ///< [s]
    std::vector<PointRange> pieces, samples;
};

/// O(points).
[[nodiscard]] FusedAxis fuse_axis(const AxisRecords& records, NoiseFitter& fitter);

}  // namespace clsurf
