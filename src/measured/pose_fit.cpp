#include "measured/pose_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Cholesky>

#include "core/not_finite.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr int most_steps = 60;
constexpr double least_step = 1e-7;     ///< [mm] motion of a point below which the fit ends
constexpr double first_damping = 1e-4;  ///< share of the mean diagonal
constexpr double least_damping = 1e-6;
constexpr double most_damping = 1e8;
constexpr double surface_reach = 0.125;  ///< step-overs, for slopes with scallops
constexpr double least_known = 0.5;      ///< share of the points that must be over the part: others have no distance
constexpr double kept_share = 0.95;      ///< share of the points with a distance in one pose that keep one in the next
// Three standard deviations: docs/howto/measured.md#the-pose.
constexpr double outlier = 3;           ///< standard deviations
constexpr double least_outlier = 2e-4;  ///< [mm]
constexpr int most_rounds = 8;
constexpr int level_rounds = 12;
constexpr double nearest_share = 0.75;    ///< share of the points from which height and tilt are determined
constexpr double height_rounding = 6e-8;  ///< relative, of float heights over level(); 2^-24

}  // namespace

std::vector<double> Distances::known_ones() const {
    std::vector<double> found;
    std::copy_if(along_normal.begin(), along_normal.end(), std::back_inserter(found),
                 [](double distance) { return std::isfinite(distance); });
    return found;
}

PoseFit::PoseFit(std::span<const Vec3> points, PredictedHeights& heights, const Form& form, const Pose& start,
                 const FreeAxes& free, double step_over, double most_shift)
    : points_(points),
      heights_(heights),
      form_(form),
      axes_(start.turn),
      step_over_(step_over),
      most_shift_(most_shift),
      left_out_(points.size(), 0) {
    for (std::size_t k = 0; k < pose_axes; ++k) {
        if (free[k]) free_.push_back(static_cast<PoseAxis>(k));
    }
    for (const Vec3& p : points_) centre_ += p / static_cast<double>(points_.size());
    start_centre_ = start(centre_);
    double squares = 0;
    for (const Vec3& p : points_) squares += (p - centre_).squaredNorm() / static_cast<double>(points_.size());
    radius_ = std::max(std::sqrt(squares), 1e-6);
}

std::vector<Vec2> PoseFit::places(const Pose& pose) const {
    std::vector<Vec2> found(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) found[i] = pose(points_[i]).head<2>();
    return found;
}

Distances PoseFit::distances(const Pose& pose) {
    heights_.prepare(places(pose), step_over_);
    Distances result;
    result.along_normal.assign(points_.size(), missing<double>);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Vec3 p = pose(points_[i]);
        const Vec2 place = p.head<2>();
        const double off = p.z() - heights_.at(place);
        const Vec2 slope = heights_.slopes(place, step_over_);
        if (!std::isfinite(off) || !slope.allFinite() || !form_.is_among_contacts(place)) continue;
        const double distance = off / std::sqrt(1 + slope.squaredNorm());
        result.along_normal[i] = distance;
        if (left_out_[i] != 0) continue;
        result.squares += distance * distance;
        ++result.known;
    }
    return result;
}

PoseFit::Equations PoseFit::equations(const FittedPose& at, double reach) {
    const auto count = static_cast<Eigen::Index>(free_.size());
    Equations e{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
    const Vec3 middle = centre(at.pose);
    Eigen::VectorXd row(count);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const double distance = at.distances.along_normal[i];
        if (!std::isfinite(distance) || left_out_[i] != 0) continue;
        const Vec3 p = at.pose(points_[i]);
        const Vec2 place = p.head<2>();
        const Vec2 slope = heights_.slopes(place, reach);
        const Vec2 form_slope = heights_.slopes(place, step_over_);
        if (!slope.allFinite() || !form_slope.allFinite()) continue;
        const Vec3 change = Vec3(-slope.x(), -slope.y(), 1) / std::sqrt(1 + form_slope.squaredNorm());
        for (Eigen::Index k = 0; k < count; ++k) {
            const auto axis = static_cast<Eigen::Index>(free_[static_cast<std::size_t>(k)]);
            row[k] =
                axis < 3 ? change.dot(axes_.col(axis)) : change.dot(axes_.col(axis - 3).cross(p - middle)) / radius_;
        }
        e.normal += row * row.transpose();
        e.right -= row * distance;
    }
    return e;
}

FittedPose PoseFit::fit(const Pose& from, double reach) {
    FittedPose best{from, distances(from)};
    const auto half = static_cast<std::size_t>(least_known * static_cast<double>(points_.size()));
    if (best.distances.known < std::max<std::size_t>(half, 1)) return best;
    // A pose must not improve because some of its points leave the part.
    const auto few = static_cast<std::size_t>(kept_share * static_cast<double>(best.distances.known));
    double damping = first_damping;
    for (int step = 0; step < most_steps && damping < most_damping; ++step) {
        const Equations e = equations(best, reach);
        const auto count = e.normal.rows();
        const double usual = std::max(e.normal.trace() / static_cast<double>(count), 1e-12);
        bool better = false;
        double moved = 0;
        while (!better && damping < most_damping) {
            Eigen::MatrixXd damped = e.normal;
            damped.diagonal().array() += damping * usual;
            const Eigen::VectorXd by = damped.ldlt().solve(e.right);
            Vec3 shift = Vec3::Zero();
            Vec3 turn = Vec3::Zero();
            for (Eigen::Index k = 0; k < count; ++k) {
                const auto axis = static_cast<Eigen::Index>(free_[static_cast<std::size_t>(k)]);
                if (axis < 3)
                    shift += by[k] * axes_.col(axis);
                else
                    turn += by[k] / radius_ * axes_.col(axis - 3);
            }
            FittedPose next{best.pose.moved(shift, turn, centre(best.pose)), {}};
            next.distances = distances(next.pose);
            moved = by.norm();
            const bool near = (centre(next.pose) - start_centre_).head<2>().norm() <= most_shift_;
            better = near && next.distances.known >= few && next.distances.known > 0 &&
                     next.distances.mean_square() < best.distances.mean_square();
            if (better) best = std::move(next);
            damping = better ? std::max(least_damping, 0.1 * damping) : 10 * damping;
            if (!better && moved < least_step) return best;
        }
        if (moved < least_step) break;
    }
    return best;
}

FittedPose PoseFit::fit_form(const Pose& from) { return fit(from, step_over_); }
FittedPose PoseFit::fit_surface(const Pose& from) { return fit(from, surface_reach * step_over_); }

/// Excludes all but the nearest share of the points.
void PoseFit::leave_out_farthest(const FittedPose& fit) {
    std::vector<double> known = fit.distances.known_ones();
    if (known.empty()) return;
    for (double& distance : known) distance = std::abs(distance);
    const double most = std::max(least_outlier, quantile_below(known, nearest_share));
    for (std::size_t i = 0; i < left_out_.size(); ++i)
        left_out_[i] = std::abs(fit.distances.along_normal[i]) > most ? 1 : 0;
}

bool PoseFit::leave_out_far_ones(const FittedPose& fit) {
    std::vector<double> known = fit.distances.known_ones();
    if (known.empty()) return false;
    const Spread spread = robust_spread(known);
    const double most = std::max(least_outlier, outlier * spread.deviation);
    bool changed = false;
    for (std::size_t i = 0; i < left_out_.size(); ++i) {
        const char out = std::abs(fit.distances.along_normal[i] - spread.median) > most ? 1 : 0;
        changed = changed || out != left_out_[i];
        left_out_[i] = out;
    }
    return changed;
}

FittedPose PoseFit::fit_without_outliers(const Pose& from) {
    std::fill(left_out_.begin(), left_out_.end(), char{0});
    FittedPose best{from, {}};
    // Height and tilt first, repeatedly from the nearest points (least trimmed squares). With all points, a missing mark would
    // shift the pose along the surface to where the mark is less deep.
    const std::vector<PoseAxis> free = free_;
    std::erase_if(free_,
                  [](PoseAxis axis) { return axis != PoseAxis::z && axis != PoseAxis::a && axis != PoseAxis::b; });
    for (int round = 0; round < level_rounds && !free_.empty() && free_.size() < free.size(); ++round) {
        best = fit_surface(best.pose);
        leave_out_farthest(best);
    }
    free_ = free;
    return fit_again(best.pose);
}

FittedPose PoseFit::fit_again(const Pose& from) {
    FittedPose best = fit_surface(from);
    for (int round = 0; round < most_rounds && leave_out_far_ones(best); ++round) best = fit_surface(best.pose);
    best.distances = distances(best.pose);
    return best;
}

PoseInformation PoseFit::information(const Pose& pose) {
    const FittedPose at{pose, distances(pose)};
    const double reach = surface_reach * step_over_;
    double highest = 0;
    for (const Vec3& p : points_) highest = std::max(highest, std::abs(pose(p).z() - heights_.level()));
    return {free_, equations(at, reach).normal, radius_, height_rounding * highest / reach};
}

}  // namespace clsurf
