#include "toolpath/acceleration_corners.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

/// Larger squares are significant: 1 in 16,000 by chance (χ² with one degree of freedom).
constexpr double gate = 16;
constexpr double hardly = 0.01;       ///< share of the greatest error or innovation: smaller ones are omitted
constexpr PointIndex tried = 32;      ///< tested positions of a jump within the innovations that it changes
constexpr PointIndex beside = 2;      ///< records: jumps may be between records
constexpr PointIndex longest = 4000;  ///< records: in a steadier motion no jumps are sought

/// The smoothed response to an acceleration step from 0 to 1 mm/s².
struct Response {
    std::vector<double> innovation;             ///< from the jump on
    std::array<std::vector<double>, 4> errors;  ///< of all points, in standard deviations
};

Response response_of(const KalmanSmoother& smoother, PointIndex half) {
    const auto n = static_cast<std::size_t>(2 * half + 1);
    const double period = smoother.model().period;
    std::array<std::vector<double>, 4> truth;
    for (std::vector<double>& values : truth) values.assign(n, 0);
    const auto middle = static_cast<std::size_t>(half);
    for (std::size_t i = middle; i < n; ++i) {
        const double t = static_cast<double>(i - middle) * period;
        truth[0][i] = 0.5 * t * t;
        truth[1][i] = t;
        truth[2][i] = i == middle ? 0.5 : 1;
    }
    const std::vector<double> none(n, 0);
    const auto of_one = [&](std::size_t d) { return std::array<std::span<const double>, 3>{truth[d], none, none}; };
    Measurements measured{of_one(0), of_one(1), of_one(2)};
    std::vector<SmoothedState> states(n);
    std::vector<Eigen::Array4d> innovations(n);
    smoother.smooth(measured, states, innovations);
    Response response;
    for (std::size_t i = middle; i < n; ++i) response.innovation.push_back(innovations[i][0]);
    for (std::size_t d = 0; d < 4; ++d) {
        const double sigma = smoother.sigma(static_cast<int>(d));
        for (std::size_t i = 0; i < n; ++i) response.errors[d].push_back((states[i][d][0] - truth[d][i]) / sigma);
    }
    return response;
}

double greatest_of(std::span<const double> values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
}

/// Cuts off small errors far from the middle; each remaining one becomes the greatest absolute value of its
/// neighbours.
std::vector<double> trimmed(const std::vector<double>& errors, PointIndex widened) {
    const auto middle = static_cast<PointIndex>(errors.size() / 2);
    const double least = hardly * greatest_of(errors);
    PointIndex reach = middle;
    const auto at = [&](PointIndex k) { return std::abs(errors[static_cast<std::size_t>(middle + k)]); };
    while (reach > 0 && at(reach) < least && at(-reach) < least) --reach;
    std::vector<double> widest;
    for (PointIndex k = -reach; k <= reach; ++k) {
        double most = 0;
        for (PointIndex by = -widened; by <= widened; ++by)
            most = std::max(most, at(std::clamp(k + by, -reach, reach)));
        widest.push_back(most);
    }
    return widest;
}

}  // namespace

AccelerationCorners::AccelerationCorners(const KalmanSmoother& smoother, const KalmanSmoother* speeds) {
    const PointIndex half = smoother.reach() + 1;
    if (half > longest) return;
    Response response = response_of(smoother, half);
    if (speeds != nullptr) response.errors[1] = response_of(*speeds, std::max(half, speeds->reach() + 1)).errors[1];
    innovation_ = std::move(response.innovation);
    const double least = hardly * greatest_of(innovation_);
    while (!innovation_.empty() && std::abs(innovation_.back()) < least) innovation_.pop_back();
    step_ = std::max<PointIndex>(1, static_cast<PointIndex>(innovation_.size()) / tried);
    for (std::size_t d = 0; d < 4; ++d) errors_[d] = trimmed(response.errors[d], std::max(beside, step_));
}

void AccelerationCorners::raise(std::span<const Eigen::Array4d> innovations, PointIndex from, PointIndex first,
                                Inflation& inflation) const {
    if (innovation_.empty()) return;
    const auto n = static_cast<PointIndex>(innovations.size());
    // The same test positions for any section of the path that is read.
    for (PointIndex at = (step_ - from % step_) % step_; at < n; at += step_) {
        Eigen::Array4d sum = Eigen::Array4d::Zero();
        double squares = 0;
        const PointIndex end = std::min(n - at, static_cast<PointIndex>(innovation_.size()));
        for (PointIndex k = 0; k < end; ++k) {
            const double expected = innovation_[static_cast<std::size_t>(k)];
            sum += expected * innovations[static_cast<std::size_t>(at + k)];
            squares += expected * expected;
        }
        const double most = sum.square().maxCoeff();
        if (!(most > gate * squares) || !(squares > 0)) continue;
        const double jump = most / (squares * squares);  // squared
        for (std::size_t d = 0; d < 4; ++d) {
            const auto reach = static_cast<PointIndex>(errors_[d].size() / 2);
            const PointIndex middle = from + at - first;
            const auto count = static_cast<PointIndex>(inflation[d].size());
            for (PointIndex i = std::max<PointIndex>(0, middle - reach); i <= std::min(count - 1, middle + reach);
                 ++i) {
                const double error = errors_[d][static_cast<std::size_t>(i - middle + reach)];
                double& factor = inflation[d][static_cast<std::size_t>(i)];
                factor = std::max(factor, 1 + jump * error * error);
            }
        }
    }
}

}  // namespace clsurf
