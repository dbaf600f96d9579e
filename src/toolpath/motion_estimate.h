#pragma once
// MotionEstimate: speed, acceleration and jerk of a trajectory from everything that its log measures of
// them, by a Kalman smoother, with the standard deviation of each.
//
// How uncertain a position is and how much the motion wanders are measured in the log itself: the model
// is the one under which the one-step predictions are most likely, no position counting for more exact
// than its quantum allows. A channel `speed` (the path's) measures the component along the path; the
// direction comes from a first smoothing of the positions alone, whose error is across the path, where it
// does not matter to first order. Channels `speed.x` … and `acceleration.x` … measure components. Theirs is
// the uncertainty with which they agree with the positions.
//
// Controls record some signals earlier than others: LinuxCNC's speed belongs to the position two records later.
// A channel is therefore first shifted by the lead at which it agrees best with what the positions tell.
//
// A machine does not move like the model: its acceleration jumps. Where the predictions show that, the standard deviations
// grow by the errors that such a jump makes (acceleration_corners.h), and where a position is far from its prediction, with it (Mehra 1972, "Approaches to adaptive filtering": the innovations tell whether a
// filter is consistent). What then remains is measured: from every second record the speeds at these records are
// estimated and compared with the differences of the records held out, and the path's speed with its channel. All
// standard deviations are scaled so that three of them hold 99.73 % of these errors. Where their mean square then still
// exceeds twice what is stated (the normalised estimation error squared of Bar-Shalom et al. 2001, section 5.4), the
// estimate is refused.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "log/log.h"
#include "numeric/kalman_smoother.h"
#include "toolpath/acceleration_corners.h"
#include "toolpath/fused_positions.h"
#include "toolpath/trajectory.h"

namespace clsurf {

enum class DerivativeMethod : std::uint8_t {
    savgol,  ///< least squares over a window (numeric/derivative.h)
    kalman,  ///< this
};

class MotionEstimate {
public:
    /// `log` and `path` must outlive it. `pieces` are smoothed each by itself. O(points), at most some 10^5 of them.
    /// Throws InputError: the errors are more than what can be stated of them.
    MotionEstimate(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces);

    /// Estimates at points [first, last] of a piece. Scratch is kept between calls.
    struct Scratch {
        std::array<std::array<std::vector<double>, 3>, 3> measured;  ///< by derivative, axis
        std::vector<double> path_speed;
        std::vector<SmoothedState> states, with_speed;
        std::vector<Eigen::Array4d> innovations;  ///< of the positions, in standard deviations
        Inflation inflation;                      ///< of the variances at the points that were estimated last
    };
    /// `out[d][axis][i]`: derivative d of point first + i [mm/s^d]; NaN where the position is missing.
    void estimate(PointRange piece, PointIndex first, PointIndex last, Scratch& scratch,
                  std::array<std::array<std::vector<double>, 3>, 4>& out) const;

    /// Standard deviation of the speed (derivative 1), of a component of acceleration (2) or jerk (3), and of a
    /// position (0), at points [first, first + out.size()) of a piece. `scratch` is that of their estimate.
    void sigmas(int derivative, PointRange piece, PointIndex first, const Scratch& scratch,
                std::span<double> out) const;
    /// Standard deviations of each coordinate of the position [mm], at points [first, first + out[0].size()).
    void position_sigmas(PointRange piece, PointIndex first, const Scratch& scratch,
                         std::array<std::vector<double>, 3>& out) const;
    /// Far from the ends of pieces, from jumps of the acceleration and from reversals [mm/s^d].
    [[nodiscard]] double sigma(int derivative) const;
    /// Normalised estimation error squared, measured in the log: 1 where the errors are as large as stated.
    [[nodiscard]] double nees() const { return nees_; }
    /// How many records the channel of the path's speed is ahead of the positions; 0: none is used.
    [[nodiscard]] double speed_lead() const { return path_speed_lead_; }

    /// Encoder and scale, where the positions are actual ones and the log has both; else nullptr.
    [[nodiscard]] const FusedPositions* fused() const { return fused_ ? &*fused_ : nullptr; }

    /// What was measured and with which uncertainty, for legends: "Kalman smoother, positions ± 0.29 µm …".
    [[nodiscard]] std::string note(int derivative) const;

private:
    /// Along the path the speed is known better than across it, if it is measured.
    [[nodiscard]] const KalmanSmoother& best(int derivative) const {
        return along_ && derivative == 1 ? *along_ : *across_;
    }
    void measure_positions(const std::vector<PointRange>& pieces, NoiseFitter& fitter);
    void measure_components(const std::vector<PointRange>& pieces);
    void measure_path_speed(const std::vector<PointRange>& pieces);
    void calibrate(const std::vector<PointRange>& pieces);
    void difference_sigmas(std::size_t axis, int derivative, PointRange piece, PointIndex first,
                           std::span<double> out) const;
    void set_scale(std::array<std::vector<double>, 3>& ratios, std::vector<double>& of_difference);
    void read(PointIndex first, PointIndex last, Scratch& scratch) const;
    [[nodiscard]] PointIndex disturbed_points() const;
    void set_inflation(const AccelerationCorners& corners, PointIndex from, PointIndex first, PointIndex last,
                       Scratch& scratch) const;
    /// Calls visit(scratch, i) for the points of the sampled sections, smoothed by their positions alone.
    template <typename Visit>
    void visit_samples(const std::vector<PointRange>& pieces, Visit&& visit) const;
    template <typename Residual>
    [[nodiscard]] double agreement(const std::vector<PointRange>& pieces, Residual&& residual) const;
    template <typename Measured, typename Estimated>
    [[nodiscard]] double lead_of(const std::vector<PointRange>& pieces, Measured&& measured,
                                 Estimated&& estimated) const;

    const Log& log_;
    Trajectory path_;
    std::optional<FusedPositions> fused_;                        ///< what `path_` is then
    std::array<std::array<const Channel*, 3>, 2> components_{};  ///< speed.x …, acceleration.x …; nullptr: not measured
    const Channel* path_speed_ = nullptr;
    std::array<double, 2> component_lead_{};  ///< records by which they are ahead of the positions
    double path_speed_lead_ = 0;
    bool rounding_rules_ = false;  ///< rounding is at least half the variance of the positions
    double scale_ = 1;             ///< of all standard deviations …
    double difference_scale_ = 1;  ///< … except those of the remaining difference of the encoder
    double nees_ = 1;              ///< normalised estimation error squared, as measured
    SmootherModel model_;
    std::optional<KalmanSmoother> across_;  ///< of all that is measured of the components
    std::optional<KalmanSmoother> along_;   ///< and of the path's speed
    std::optional<AccelerationCorners> corners_;
};

}  // namespace clsurf
