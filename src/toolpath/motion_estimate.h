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

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "log/log.h"
#include "numeric/kalman_smoother.h"
#include "toolpath/trajectory.h"

namespace clsurf {

enum class DerivativeMethod : std::uint8_t {
    savgol,  ///< least squares over a window (numeric/derivative.h)
    kalman,  ///< this
};

class MotionEstimate {
public:
    /// `log` and `path` must outlive it. `pieces` are smoothed each by itself. O(points), at most some 10^5 of them.
    MotionEstimate(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces);

    /// Estimates at points [first, last] of a piece. Scratch is kept between calls.
    struct Scratch {
        std::array<std::array<std::vector<double>, 3>, 3> measured;  ///< by derivative, axis
        std::vector<double> path_speed;
        std::vector<SmoothedState> states, with_speed;
    };
    /// `out[d][axis][i]`: derivative d of point first + i [mm/s^d]; NaN where the position is missing.
    void estimate(PointRange piece, PointIndex first, PointIndex last, Scratch& scratch,
                  std::array<std::array<std::vector<double>, 3>, 4>& out) const;

    /// Standard deviation of the speed (derivative 1), of a component of acceleration (2) or jerk (3), and of a
    /// position (0), at points [first, first + out.size()) of a piece.
    void sigmas(int derivative, PointRange piece, PointIndex first, std::span<double> out) const;
    /// Far from the ends of pieces [mm/s^d].
    [[nodiscard]] double sigma(int derivative) const { return best(derivative).sigma(derivative); }

    /// What was measured and with which uncertainty, for legends: "Kalman smoother, positions ± 0.29 µm …".
    [[nodiscard]] std::string note(int derivative) const;

private:
    /// Along the path the speed is known better than across it, if it is measured.
    [[nodiscard]] const KalmanSmoother& best(int derivative) const {
        return along_ && derivative == 1 ? *along_ : *across_;
    }
    void measure_positions(const std::vector<PointRange>& pieces);
    void measure_components(const std::vector<PointRange>& pieces);
    void measure_path_speed(const std::vector<PointRange>& pieces);
    void read(PointIndex first, PointIndex last, Scratch& scratch) const;
    template <typename Residual>
    [[nodiscard]] double agreement(const std::vector<PointRange>& pieces, Residual&& residual) const;

    const Log& log_;
    const Trajectory& path_;
    std::array<std::array<const Channel*, 3>, 2> components_{};  ///< speed.x …, acceleration.x …; nullptr: not measured
    const Channel* path_speed_ = nullptr;
    SmootherModel model_;
    std::optional<KalmanSmoother> across_;  ///< of all that is measured of the components
    std::optional<KalmanSmoother> along_;   ///< and of the path's speed
};

}  // namespace clsurf
