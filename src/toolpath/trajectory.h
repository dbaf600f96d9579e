#pragma once
// Trajectory: workpiece positions of one role, read by block. For three axes it stores nothing: it applies an offset, and a
// rotation if the work system is rotated, to the log's columns. With rotary axes it stores the tool tip in the workpiece,
// computed once: 24 bytes a point.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/channel_view.h"
#include "core/geometry.h"
#include "log/log.h"
#include "machine/kinematics.h"

namespace clsurf {

class ToolAxes;

struct Trajectory {
    Role role = Role::commanded;
    std::array<ChannelView, 3> axes;  ///< machine positions x, y, z, or of the tip before the offset [mm]
    Vec3 offset = Vec3::Zero();       ///< workpiece = turn · machine + offset [mm]
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    PointIndex count = 0;
    double period = 0;                             ///< [s]
    std::string name;                              ///< of the log, for messages
    std::shared_ptr<const Kinematics> kinematics;  ///< of machines with rotary axes; nullptr: three axes
    /// In the workpiece, if there are no kinematics and a program states them (stated_axes.h); nullptr: along z.
    std::shared_ptr<const ToolAxes> stated_axes;
    bool axis_known = true;  ///< false: the tool turns, and its axis is unknown without kinematics
    double ball = 0;         ///< [mm] 0: positions are those of the tip; else as in upright_ball()
    std::shared_ptr<const void> keep_alive;

    /// Gathers points [begin, begin + x.size()); NaN if the log has none. All spans same size.
    void read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const;
    [[nodiscard]] Vec3 at(PointIndex point) const;
    /// Whether positions are those of the linear axes, except for the pose.
    [[nodiscard]] bool is_of_linear_axes() const { return kinematics == nullptr && ball == 0; }
    /// The machine's position of the workpiece's zero, and the orientation of its axes there.
    [[nodiscard]] Eigen::Isometry3d pose() const;
    /// Replaces the pose: machine = pose · workpiece.
    void set_pose(const Eigen::Isometry3d& pose);
};

/// The positions of one role: work offset and tool length as `offset` [mm]; through the chain of `kinematics`, if
/// given, from all five axes. Throws InputError if the log lacks the role, or rotary axes that the kinematics need.
/// With rotary axes O(points), parallel.
[[nodiscard]] Trajectory reconstruct(const Log& log, Role role, const Vec3& offset,
                                     std::shared_ptr<const Kinematics> kinematics = nullptr);
/// The same with a rotated work system: machine = pose · workpiece.
[[nodiscard]] Trajectory reconstruct(const Log& log, Role role, const Eigen::Isometry3d& pose,
                                     std::shared_ptr<const Kinematics> kinematics = nullptr);

/// The box of all finite positions [mm]. O(points), parallel.
[[nodiscard]] Box3 box_of(const Trajectory& path);

/// Replaces the tips of a ball of that radius [mm] by those of an upright ball with the same centre: tip + radius
/// (axis − z). The ball cuts the same, and algorithms for upright tools apply. `like` has kinematics or stated axes.
/// O(points), parallel.
[[nodiscard]] Trajectory upright_ball(const Log& log, const Trajectory& like, double radius);

/// Whether the tool axis ever leaves z, by more than 10⁻⁶ rad. False without kinematics and stated axes. O(points).
[[nodiscard]] bool tilts(const Log& log, const Trajectory& trajectory);

/// Whether reconstruct_like() finds the channels that it needs: with kinematics also the rotary axes.
[[nodiscard]] bool can_reconstruct_like(const Log& log, Role role, const Trajectory& like);

/// Another role of the same log, with the same transformation to the workpiece.
[[nodiscard]] Trajectory reconstruct_like(const Log& log, Role role, const Trajectory& like);

/// The tool axes of a role, transformed to the workpiece with the kinematics of `like`, or those that `like` has stated.
/// Throws InputError if the log lacks the angles. O(points), parallel; 24 bytes a point.
[[nodiscard]] ToolAxes tool_axes(const Log& log, Role role, const Trajectory& like);

/// The angle of a rotary axis as the control counts it [rad]: a view of the log's column, which must outlive it. Throws
/// InputError if the log does not have it.
[[nodiscard]] ChannelView axis_angles(const Log& log, Role role, char letter);

/// Reports passages of the tool axis near its pole: within 2° of it the rotation axis turns by more than 45°. Adds
/// `path.pole`. O(points).
void note_poles(const Log& log, Role role, const Kinematics& kinematics, Diagnostics& diagnostics);

/// A rotary axis that moves.
struct RotaryMotion {
    char letter = 'a';
    double range = 0;  ///< [rad] between its lowest and its highest angle
};
/// The first rotary axis that moves by more than 0.01°. O(points) if there are any.
[[nodiscard]] std::optional<RotaryMotion> find_rotary_motion(const Log& log, Role role);

/// Without kinematics: a warning `path.rotary` if a rotary axis moves, because then the positions of the linear axes
/// are not those of the tool on the workpiece. O(points).
void note_rotary(const Log& log, Role role, Diagnostics& diagnostics);

}  // namespace clsurf
