#pragma once
// Kalman smoother: position, speed, acceleration and jerk of an axis from all of its measurements, as one
// consistent estimate with its standard deviation.
//
// Fixed-interval smoothing after Rauch, Tung, Striebel 1965 ("Maximum likelihood estimates of linear dynamic
// systems"). State p, v, a, j; the jerk is constant except for white snap of density q:
//
//     p' = v,  v' = a,  a' = j,  j' = w,   E w(t) w(s) = q δ(t − s)
//
// The measurements are positions, and speeds and accelerations if the log has them. The gains do not depend on
// the data: they are computed once, from an unknown start until they settle, so a point costs some hundred
// operations. Estimates are exact on cubics. Away from both ends the variance is constant.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"

namespace clsurf {

struct SmootherModel {
    double period = 0;          ///< [s]
    double position_sigma = 0;  ///< standard deviation of a measured position [mm], > 0
    double speed_sigma = std::numeric_limits<double>::infinity();         ///< [mm/s]; infinite: none measured
    double acceleration_sigma = std::numeric_limits<double>::infinity();  ///< [mm/s²]
    /// Scaled density of the snap, q · period⁷ / position_sigma²: how much the motion wanders in a period, relative
    /// to the uncertainty of the measurement.
    double wandering = 1e-9;

    [[nodiscard]] bool has_speed() const { return speed_sigma < std::numeric_limits<double>::infinity(); }
    [[nodiscard]] bool has_acceleration() const { return acceleration_sigma < std::numeric_limits<double>::infinity(); }
};

/// Three axes side by side: their p, v, a, j at a point (the fourth lane is empty).
using SmoothedState = std::array<Eigen::Array4d, 4>;

/// Measurements at consecutive points, one array per axis; empty: not measured. [mm], [mm/s], [mm/s²]
struct Measurements {
    std::array<std::span<const double>, 3> position, speed, acceleration;
};

class KalmanSmoother {
public:
    explicit KalmanSmoother(const SmootherModel& model);

    [[nodiscard]] const SmootherModel& model() const { return model_; }
    /// Distance in points beyond which others no longer matter (a part in 10^5 of the effect of the nearest).
    [[nodiscard]] PointIndex reach() const { return static_cast<PointIndex>(forward_.size()); }

    /// Smooths consecutive points with all their measurements; `states` has one for each. A missing value (NaN) is
    /// ignored. `innovations`, if it is not empty, also has one for each point: how far the positions are from their
    /// one-step predictions, in standard deviations; 0 while the gains settle.
    void smooth(const Measurements& measured, std::span<SmoothedState> states,
                std::span<Eigen::Array4d> innovations = {}) const;

    /// Standard deviation of the smoothed derivative 0 … 3 at points [first, first + out.size()) of `count` [mm/s^d].
    void sigmas(int derivative, PointIndex count, PointIndex first, std::span<double> out) const;
    /// The same far from both ends.
    [[nodiscard]] double sigma(int derivative) const;

    /// Sums over the one-step predictions of an axis after the filter has settled: squares in units of their variance
    /// with position_sigma 1, and their number. For models of positions alone.
    struct Innovations {
        double squares = 0;
        PointIndex count = 0;
        double log_variance = 0;  ///< of one prediction
    };
    [[nodiscard]] Innovations innovations(std::span<const double> positions) const;

private:
    using Matrix = Eigen::Matrix4d;
    /// Gains of a step, in units of period and position_sigma.
    struct Step {
        std::array<std::array<double, 4>, 3> gain{};  ///< by measured derivative: of p, v, a, j
        std::array<std::array<double, 4>, 4> back{};  ///< C of the backward pass
    };

    [[nodiscard]] const Step& step(std::size_t i) const {
        return forward_[i < forward_.size() ? i : forward_.size() - 1];
    }
    [[nodiscard]] std::array<double, 4> unit_of_state() const;

    SmootherModel model_;
    std::vector<Step> forward_;  ///< from the first point until the gains settle
    std::vector<Matrix> filtered_,
        alone_;  ///< likewise: covariances after a point; what smoothing adds to those of the next
    std::vector<std::array<double, 4>> end_variance_;  ///< by distance from one end, with the other far away
    double innovation_variance_ = 1;
};

}  // namespace clsurf
