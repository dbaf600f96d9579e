#pragma once
// Trajectory: workpiece positions of one role, read by block. For three axes it stores nothing: it is
// an offset, and where the work system is turned a rotation, over the log's columns. With rotary axes it holds the tool's tip in the workpiece, computed
// once: 24 bytes a point.

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
    /// In the workpiece, where there are no kinematics and a program states them (stated_axes.h); nullptr: along z.
    std::shared_ptr<const ToolAxes> stated_axes;
    bool axis_known = true;  ///< false: the tool turns, and without kinematics nothing tells how
    double ball = 0;         ///< [mm] 0: positions are those of the tip; else as upright_ball() has them
    std::shared_ptr<const void> keep_alive;

    /// Gathers points [begin, begin + x.size()); NaN where the log has none. All spans same size.
    void read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const;
    [[nodiscard]] Vec3 at(PointIndex point) const;
    /// Whether positions are those of the linear axes, but for the pose.
    [[nodiscard]] bool is_of_linear_axes() const { return kinematics == nullptr && ball == 0; }
    /// The machine's position of the workpiece's zero, and how its axes lie there.
    [[nodiscard]] Eigen::Isometry3d pose() const;
    /// Other such positions: machine = pose · workpiece.
    void set_pose(const Eigen::Isometry3d& pose);
};

/// The positions of one role: work offset and tool length as `offset` [mm]; through the chain of
/// `kinematics`, if given, from all five axes. Throws InputError when the log has no such role, or not
/// the rotary axes that the kinematics need. With rotary axes O(points), parallel.
[[nodiscard]] Trajectory reconstruct(const Log& log, Role role, const Vec3& offset,
                                     std::shared_ptr<const Kinematics> kinematics = nullptr);
/// The same with a turned work system: machine = pose · workpiece.
[[nodiscard]] Trajectory reconstruct(const Log& log, Role role, const Eigen::Isometry3d& pose,
                                     std::shared_ptr<const Kinematics> kinematics = nullptr);

/// The box of all finite positions [mm]. O(points), parallel.
[[nodiscard]] Box3 box_of(const Trajectory& path);

/// In place of the tips of a ball of that radius [mm] those that it would have with its axis along z and the same
/// centre: tip + radius (axis − z). The ball cuts the same, and what knows upright tools knows it. `like`
/// has kinematics or stated axes. O(points), parallel.
[[nodiscard]] Trajectory upright_ball(const Log& log, const Trajectory& like, double radius);

/// Whether the tool axis ever leaves z, by more than 10⁻⁶ rad. False without kinematics and stated axes. O(points).
[[nodiscard]] bool tilts(const Log& log, const Trajectory& trajectory);

/// Whether reconstruct_like() finds the channels that it needs: with kinematics the rotary axes too.
[[nodiscard]] bool can_reconstruct_like(const Log& log, Role role, const Trajectory& like);

/// Another role of the same log, by the same way into the workpiece.
[[nodiscard]] Trajectory reconstruct_like(const Log& log, Role role, const Trajectory& like);

/// The tool axes of a role, brought into the workpiece as `like` was, which has kinematics, or those that `like` has stated.
/// Throws InputError where the log lacks the angles. O(points), parallel; 24 bytes a point.
[[nodiscard]] ToolAxes tool_axes(const Log& log, Role role, const Trajectory& like);

/// The angle of a rotary axis as the control counts it [rad]: a view of the log's column, which must outlive it. Throws
/// InputError where the log does not have it.
[[nodiscard]] ChannelView axis_angles(const Log& log, Role role, char letter);

/// Notes where the tool axis passes its pole: within 2° of it the rotation axis turns by more than
/// 45°. Adds `path.pole`. O(points).
void note_poles(const Log& log, Role role, const Kinematics& kinematics, Diagnostics& diagnostics);

/// A rotary axis that moves.
struct RotaryMotion {
    char letter = 'a';
    double range = 0;  ///< [rad] between its lowest and its highest angle
};
/// The first of the rotary axes that moves by more than 0.01°. O(points) where there are any.
[[nodiscard]] std::optional<RotaryMotion> find_rotary_motion(const Log& log, Role role);

/// Without kinematics: a warning `path.rotary` where a rotary axis moves, for then the positions of the
/// linear axes are not those of the tool on the workpiece. O(points).
void note_rotary(const Log& log, Role role, Diagnostics& diagnostics);

}  // namespace clsurf
