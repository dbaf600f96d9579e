#pragma once
// What a Kalman smoother needs to know of a log: sections that show its motion, the noise of a channel and how much its
// motion wanders, and a channel as it is at other times than its records.

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
inline constexpr PointIndex most_lead = 12;  ///< records: further ahead no control has been seen to record a signal
inline constexpr double better_lead = 0.8;   ///< squares of a lead that counts, over those of none

/// Sections of at most 2,000 points spread over the pieces that are long enough to tell anything; at most some 48.
[[nodiscard]] std::vector<PointRange> sample_sections(const std::vector<PointRange>& pieces);

/// Values of a channel that is `lead` records ahead, at points from `first`; cubic between records, NaN beyond them.
void copy_ahead(const ChannelView& view, PointIndex count, PointIndex first, double lead, std::vector<double>& out);

/// All points of a log, cut where records are missing. O(points) where it has a time channel.
[[nodiscard]] std::vector<PointRange> cut_at_gaps(const Log& log, std::vector<PointRange> pieces);

/// A channel's noise and its motion.
struct NoiseFit {
    double sigma = 0;             ///< standard deviation of a value [its unit]
    double wandering = 1e-9;      ///< SmootherModel::wandering
    bool rounding_rules = false;  ///< rounding is at least half of the variance
    bool moved = false;           ///< false: no series was long enough, and `sigma` is the floor
};

/// Fits noise and motion by maximum likelihood. Keeps the filters that it tries, for it tries the same ones each time.
class NoiseFitter {
public:
    /// The fit under which the one-step predictions of all series are most likely, no value being more exact than `floor`.
    [[nodiscard]] NoiseFit fit(const std::vector<std::vector<double>>& series, double floor);

private:
    [[nodiscard]] const KalmanSmoother& filter(int step, double wandering);
    std::map<int, KalmanSmoother> filters_;  ///< by the number of the step from the greatest wandering
};

/// Whether an axis moves by so much more than the floor of its noise that it tells anything of its motion.
[[nodiscard]] bool moves(const std::vector<double>& positions, double floor);

/// White noise of a channel that stands, from its second differences: (x₋₁ − 2x₀ + x₁)² has six times its variance. Slow
/// drift is not noise. NaN values are left out; 0: fewer than three values.
[[nodiscard]] double noise_at_rest(const std::vector<std::vector<double>>& series);

}  // namespace clsurf
