#pragma once
// PoseFit: the rigid pose of measured points for which the sum of squares of their distances from the as-machined surface is
// least (Levenberg-Marquardt). Distances are along the normal.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "machined/form.h"
#include "measured/pose.h"
#include "measured/predicted_heights.h"

namespace clsurf {

/// Degrees of freedom of a pose, in the axes that the measurement has at its start.
enum class PoseAxis : std::uint8_t { x, y, z, a, b, c };
inline constexpr std::size_t pose_axes = 6;
using FreeAxes = std::array<bool, pose_axes>;

/// Distances of points from the surface in a pose.
struct Distances {
    std::vector<double>
        along_normal;  ///< [mm] + outside of the part; NaN: nothing was cut there, or only the flank stands
    std::size_t known = 0;
    double squares = 0;  ///< their sum [mm²]

    [[nodiscard]] double mean_square() const { return squares / static_cast<double>(known); }
    /// Those that are not NaN, also of points that a fit leaves out.
    [[nodiscard]] std::vector<double> known_ones() const;
};

struct FittedPose {
    Pose pose;
    Distances distances;
};

/// What a fit tells of its degrees of freedom: along `axes`, in mm that a point moves (rotations: at the root
/// mean square distance of the points from their centre).
struct PoseInformation {
    std::vector<PoseAxis> axes;  ///< that were free
    Eigen::MatrixXd normal;      ///< JᵀJ over them
    double rotation_radius = 1;  ///< [mm]
    double slope_noise = 0;      ///< of the surface's slopes, from the rounding of its heights
};

class PoseFit {
public:
    /// `points` [mm] in the axes of the measurement, `form` of the surface where they can lie. All must outlive it.
    /// `most_shift` [mm], seen from above: how far their centre may lie from where `start` puts it.
    PoseFit(std::span<const Vec3> points, PredictedHeights& heights, const Form& form, const Pose& start,
            const FreeAxes& free, double step_over, double most_shift);

    [[nodiscard]] Distances distances(const Pose& pose);
    /// Slopes over a whole step-over: scallops drop out, and the form alone leads.
    [[nodiscard]] FittedPose fit_form(const Pose& from);
    /// Slopes of the surface with its scallops.
    [[nodiscard]] FittedPose fit_surface(const Pose& from);
    /// The same, again and again without the points that then lie too far off (three standard deviations, robust): a mark that
    /// is missing, dirt. Distances are still given for all of them, known and squares are of the others.
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
