#pragma once
// PoseFit: the rigid pose of measured points with the least sum of squares of their distances from the as-machined surface
// (Levenberg-Marquardt). Distances are along the normal.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "machined/form.h"
#include "measured/pose.h"
#include "measured/predicted_heights.h"

namespace clsurf {

/// Degrees of freedom of a pose, in the axes of the measurement at its start.
enum class PoseAxis : std::uint8_t { x, y, z, a, b, c };
inline constexpr std::size_t pose_axes = 6;
using FreeAxes = std::array<bool, pose_axes>;

/// Distances of points from the surface for a pose.
struct Distances {
    std::vector<double>
        along_normal;  ///< [mm] + outside of the part; NaN: nothing was cut there, or only the flank of the tool
    std::size_t known = 0;
    double squares = 0;  ///< their sum [mm²]

    [[nodiscard]] double mean_square() const { return squares / static_cast<double>(known); }
    /// The distances that are not NaN, including points that a fit excludes.
    [[nodiscard]] std::vector<double> known_ones() const;
};

struct FittedPose {
    Pose pose;
    Distances distances;
};

/// The information of a fit about its degrees of freedom along `axes`, in mm of motion of a point (rotations: at the root mean
/// square distance of the points from their centre).
struct PoseInformation {
    std::vector<PoseAxis> axes;  ///< axes that were free
    Eigen::MatrixXd normal;      ///< JᵀJ over them
    double rotation_radius = 1;  ///< [mm]
    double slope_noise = 0;      ///< of the surface's slopes, from the rounding of its heights
};

class PoseFit {
public:
    /// `points` [mm]: in the axes of the measurement. `form`: of the surface in the region of the points. All must outlive it.
    /// `most_shift` [mm], seen from above: largest distance of their centre from its place in `start`.
    PoseFit(std::span<const Vec3> points, PredictedHeights& heights, const Form& form, const Pose& start,
            const FreeAxes& free, double step_over, double most_shift);

    [[nodiscard]] Distances distances(const Pose& pose);
    /// Fit with slopes over a whole step-over: scallops cancel, and only the form counts.
    [[nodiscard]] FittedPose fit_form(const Pose& from);
    /// Fit with slopes of the surface with its scallops.
    [[nodiscard]] FittedPose fit_surface(const Pose& from);
    /// The same, repeated without outliers (three standard deviations, robust), for example a missing mark or dirt. Distances
    /// are still given for all points; known and squares exclude outliers.
    [[nodiscard]] FittedPose fit_without_outliers(const Pose& from);
    [[nodiscard]] PoseInformation information(const Pose& pose);
    [[nodiscard]] bool is_left_out(std::size_t point) const { return left_out_[point] != 0; }
    /// The mean of the points on the part [mm].
    [[nodiscard]] Vec3 centre(const Pose& pose) const { return pose(centre_); }
    [[nodiscard]] const Eigen::Matrix3d& axes() const { return axes_; }

private:
    struct Equations {
        Eigen::MatrixXd normal;
        Eigen::VectorXd right;
    };
    [[nodiscard]] FittedPose fit(const Pose& from, double reach);
    [[nodiscard]] Equations equations(const FittedPose& at, double reach);
    [[nodiscard]] std::vector<Vec2> places(const Pose& pose) const;
    [[nodiscard]] FittedPose fit_again(const Pose& from);
    void leave_out_farthest(const FittedPose& fit);
    [[nodiscard]] bool leave_out_far_ones(const FittedPose& fit);

    std::span<const Vec3> points_;
    PredictedHeights& heights_;
    const Form& form_;
    Eigen::Matrix3d axes_;
    std::vector<PoseAxis> free_;
    double step_over_, most_shift_;
    std::vector<char> left_out_;  ///< of each point
    Vec3 start_centre_ = Vec3::Zero();
    Vec3 centre_ = Vec3::Zero();
    double radius_ = 1;
};

}  // namespace clsurf
