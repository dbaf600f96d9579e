#pragma once
// MotionEstimate: speed, acceleration and jerk of a trajectory from all measurements of them in its log, by a Kalman
// smoother, with the standard deviation of each.
//
// The uncertainty of positions and the wandering of the motion are estimated from the log itself: the model maximises the
// likelihood of the one-step predictions, and no position is more exact than its quantum allows. A channel `speed` (the
// path's) measures the component along the path. Its direction comes from a first smoothing of the positions alone; the
// error of this direction is across the path, where it has no effect to first order. Channels `speed.x` … and
// `acceleration.x` … measure components. Their uncertainty is their disagreement with the positions.
//
// Controls record some signals earlier than others: LinuxCNC's speed belongs to the position two records later.
// A channel is therefore first shifted by the lead at which it agrees best with the positions.
//
// A machine does not move like the model: its acceleration jumps. If the predictions show a jump, the standard deviations
// are increased by the errors that such a jump makes (acceleration_corners.h). If a position is far from its prediction,
// they increase with its distance (Mehra 1972, "Approaches to adaptive filtering": the innovations show whether a filter
// is consistent). The remaining errors are measured: speeds are estimated from every second record and compared with the
// differences of the records held out, and the path's speed with its channel. All standard deviations are scaled so that
// three of them cover 99.73 % of these errors. If the mean square of the errors then still exceeds twice the stated one
// (the normalised estimation error squared of Bar-Shalom et al. 2001, section 5.4), the estimate is refused.

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
    /// `log` and `path` must outlive it. `pieces` are smoothed each by itself. O(points), for the fit at most some
    /// 10^5 of them. Throws InputError if the errors exceed what its standard deviations can state.
    MotionEstimate(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces);

    /// Estimates at points [first, last] of a piece. Scratch is kept between calls.
    struct Scratch {
        std::array<std::array<std::vector<double>, 3>, 3> measured;  ///< by derivative, axis
        std::vector<double> path_speed;
        std::vector<SmoothedState> states, with_speed;
        std::vector<Eigen::Array4d> innovations;  ///< of the positions, in standard deviations
        Inflation inflation;                      ///< of the variances at the points that were estimated last
    };
    /// `out[d][axis][i]`: derivative d of point first + i [mm/s^d]; NaN if the position is missing.
    void estimate(PointRange piece, PointIndex first, PointIndex last, Scratch& scratch,
                  std::array<std::array<std::vector<double>, 3>, 4>& out) const;

    /// Standard deviation of the speed (derivative 1), of a component of acceleration (2) or jerk (3), and of a
    /// position (0), at points [first, first + out.size()) of a piece. `scratch` is that of their estimate.
    void sigmas(int derivative, PointRange piece, PointIndex first, const Scratch& scratch,
                std::span<double> out) const;
    /// Standard deviations of each coordinate of the position [mm], at points [first, first + out[0].size()).
    void position_sigmas(PointRange piece, PointIndex first, const Scratch& scratch,
                         std::array<std::vector<double>, 3>& out) const;
    /// Standard deviation far from the ends of pieces, from jumps of the acceleration and from reversals [mm/s^d].
    [[nodiscard]] double sigma(int derivative) const;
    /// Normalised estimation error squared, measured in the log: 1 if the errors are as large as stated.
    [[nodiscard]] double nees() const { return nees_; }
    /// How many records the channel of the path's speed leads the positions; 0: none is used.
    [[nodiscard]] double speed_lead() const { return path_speed_lead_; }

    /// Encoder and scale, if the positions are actual ones and the log has both; else nullptr.
    [[nodiscard]] const FusedPositions* fused() const { return fused_ ? &*fused_ : nullptr; }

    /// The measurements and their uncertainties, for legends: "Kalman smoother, positions ± 0.29 µm …".
    [[nodiscard]] std::string note(int derivative) const;

private:
    /// If the speed along the path is measured, it is more certain than across it.
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
    std::optional<FusedPositions> fused_;                        ///< owns what `path_` then refers to
    std::array<std::array<const Channel*, 3>, 2> components_{};  ///< speed.x …, acceleration.x …; nullptr: not measured
    const Channel* path_speed_ = nullptr;
    std::array<double, 2> component_lead_{};  ///< records by which they lead the positions
    double path_speed_lead_ = 0;
    bool rounding_rules_ = false;  ///< rounding is at least half the variance of the positions
    double scale_ = 1;             ///< factor of all standard deviations …
    double difference_scale_ = 1;  ///< … except those of the remaining difference of the encoder
    double nees_ = 1;              ///< normalised estimation error squared, as measured
    SmootherModel model_;
    std::optional<KalmanSmoother> across_;  ///< with all measurements of the components
    std::optional<KalmanSmoother> along_;   ///< and with the path's speed
    std::optional<AccelerationCorners> corners_;
};

}  // namespace clsurf
