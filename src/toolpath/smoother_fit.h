#pragma once
// Inputs of a Kalman smoother from a log: sections that show its motion, the noise of a channel and how much its motion
// wanders, and values of a channel between its records.

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "core/channel_view.h"
#include "core/point.h"
#include "log/log.h"
#include "numeric/kalman_smoother.h"

namespace clsurf {

inline constexpr double finest_position = 1e-8;  ///< [mm] no position is more exact
/// 2⁷: `wandering` with a period twice as long.
inline constexpr double two_periods_7 = 128;
inline constexpr PointIndex most_lead = 12;  ///< records: the greatest lead of a signal that was seen in a control
inline constexpr double better_lead =
    0.8;  ///< the residual squares with a lead must fall below this share of those without

/// Sections of at most 2,000 points, spread over the pieces that are long enough to be informative; at most some 48.
[[nodiscard]] std::vector<PointRange> sample_sections(const std::vector<PointRange>& pieces);

/// Values of a channel that leads by `lead` records, at points from `first`; cubic between records, NaN beyond them.
void copy_ahead(const ChannelView& view, PointIndex count, PointIndex first, double lead, std::vector<double>& out);

/// All points of a log, cut at missing records. O(points) if it has a time channel.
[[nodiscard]] std::vector<PointRange> cut_at_gaps(const Log& log, std::vector<PointRange> pieces);

/// A channel's noise and its motion.
struct NoiseFit {
    double sigma = 0;             ///< standard deviation of a value [its unit]
    double wandering = 1e-9;      ///< SmootherModel::wandering
    bool rounding_rules = false;  ///< rounding is at least half of the variance
    bool moved = false;           ///< false: no series was long enough, and `sigma` is the floor
};

/// Fits noise and motion by maximum likelihood. Keeps its trial filters, because it tries the same ones each time.
class NoiseFitter {
public:
    /// The fit under which the one-step predictions of all series are most likely. `floor`: lower bound of the noise.
    [[nodiscard]] NoiseFit fit(const std::vector<std::vector<double>>& series, double floor);

private:
    [[nodiscard]] const KalmanSmoother& filter(int step, double wandering);
    std::map<int, KalmanSmoother> filters_;  ///< by the index of the step from the greatest wandering
};

/// Whether an axis moves by so much more than the floor of its noise that its motion can be fitted.
[[nodiscard]] bool moves(const std::vector<double>& positions, double floor);

/// White noise of a channel at rest, from its second differences: (x₋₁ − 2x₀ + x₁)² has six times its variance. Slow
/// drift is not noise. NaN values are skipped; 0: fewer than three values.
[[nodiscard]] double noise_at_rest(const std::vector<std::vector<double>>& series);

}  // namespace clsurf
