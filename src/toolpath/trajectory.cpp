#include "toolpath/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/column.h"
#include "core/error.h"
#include "core/units.h"
#include "toolpath/tool_axes.h"

namespace clsurf {

void Trajectory::read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const {
    const std::array<std::span<double>, 3> out{x, y, z};
    if (!turn.isIdentity(0)) {
        for (int axis = 0; axis < 3; ++axis) copy_block(axes[axis], begin, out[axis]);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3 p = turn * Vec3(x[i], y[i], z[i]) + offset;
            x[i] = p.x();
            y[i] = p.y();
            z[i] = p.z();
        }
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        copy_block(axes[axis], begin, out[axis]);
        if (offset[axis] == 0.0) continue;
        for (double& value : out[axis]) value += offset[axis];
    }
}

Vec3 Trajectory::at(PointIndex point) const {
    const Vec3 machine(axes[0].at(point), axes[1].at(point), axes[2].at(point));
    return turn.isIdentity(0) ? Vec3(machine + offset) : Vec3(turn * machine + offset);
}

Eigen::Isometry3d Trajectory::pose() const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn.transpose();
    pose.translation() = -(turn.transpose() * offset);
    return pose;
}

void Trajectory::set_pose(const Eigen::Isometry3d& pose) {
    turn = pose.linear().transpose();
    offset = -(turn * pose.translation());
}

namespace {

/// The channel of an axis, or an error that says what is missing.
const Channel& channel_of(const Log& log, Role role, char letter) {
    const std::string name = std::string(prefix_of(role)) + "." + letter;
    if (const Channel* channel = log.find(name)) return *channel;
    throw InputError(Place::of_file(log.name),
                     "no " + std::string(name_of(role)) + " positions: channel '" + name + "' is missing",
                     "`clsurf info` lists the channels that the log has");
}

/// A linear axis; if the role has only the other two (a lathe), it is at 0.
ChannelView linear_axis(const Log& log, Role role, char letter) {
    static constexpr double zero = 0;
    const std::string name = std::string(prefix_of(role)) + "." + letter;
    if (log.find(name) != nullptr || !log.has(role)) return channel_of(log, role, letter).values;
    return repeated_view(zero, log.records);
}

Trajectory trajectory_of(const Log& log, Role role) {
    Trajectory trajectory;
    trajectory.role = role;
    trajectory.count = log.records;
    trajectory.period = log.period;
    trajectory.name = log.name;
    trajectory.keep_alive = log.keep_alive;
    return trajectory;
}

/// Angles of both rotary axes, read by block, signs applied.
class AngleReader {
public:
    AngleReader(const Log& log, Role role, const Kinematics& kinematics)
        : tilt_(&channel_of(log, role, kinematics.tilt.letter).values),
          rotation_(&channel_of(log, role, kinematics.rotation.letter).values),
          tilt_factor_(kinematics.tilt.sign * rad_per_deg),
          rotation_factor_(kinematics.rotation.sign * rad_per_deg) {}

    void read(PointIndex begin, std::span<double> tilt, std::span<double> rotation) const {
        copy_block(*tilt_, begin, tilt);
        copy_block(*rotation_, begin, rotation);
        for (double& value : tilt) value *= tilt_factor_;
        for (double& value : rotation) value *= rotation_factor_;
    }

private:
    const ChannelView* tilt_;
    const ChannelView* rotation_;
    double tilt_factor_, rotation_factor_;
};

/// Calls body(point, angles) for the points in order, until it returns true. Returns whether it did.
template <typename Body>
bool for_angles(const Log& log, const AngleReader& angles, Body&& body) {
    std::vector<double> tilt, rotation;
    for (PointIndex begin = 0; begin < log.records; begin += block_points) {
        const auto n = static_cast<std::size_t>(std::min(block_points, log.records - begin));
        tilt.resize(n);
        rotation.resize(n);
        angles.read(begin, tilt, rotation);
        for (std::size_t i = 0; i < n; ++i) {
            if (body(begin + static_cast<PointIndex>(i), RotaryAngles{tilt[i], rotation[i]})) return true;
        }
    }
    return false;
}

using OwnColumns = std::array<Column<double>, 3>;

/// Columns of `count` points. compute(first, last, x, y, z) fills a section of them.
template <typename Compute>
std::shared_ptr<const OwnColumns> make_columns(PointIndex count, Compute&& compute) {
    auto columns = std::make_shared<OwnColumns>();
    for (Column<double>& column : *columns) column.resize(static_cast<std::size_t>(count));
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        const auto at = static_cast<std::size_t>(first);
        const auto size = static_cast<std::size_t>(last - first);
        compute(first, std::span(columns->at(0).data() + at, size), std::span(columns->at(1).data() + at, size),
                std::span(columns->at(2).data() + at, size));
    });
    return columns;
}

/// Replaces the columns of a trajectory by its own.
void set_columns(Trajectory& trajectory, std::shared_ptr<const OwnColumns> columns) {
    for (std::size_t axis = 0; axis < 3; ++axis) trajectory.axes[axis] = view_of(columns->at(axis));
    trajectory.keep_alive = std::move(columns);
}

}  // namespace

namespace {

/// Replaces tips by those of an upright ball of that radius, with the stated axes.
void use_upright_ball(Trajectory& trajectory, double ball) {
    const ToolAxes& axes = *trajectory.stated_axes;
    const std::array<ChannelView, 3> linear = trajectory.axes;
    const Eigen::Matrix3d to_machine = trajectory.turn.transpose();
    const auto compute = [&](PointIndex first, std::span<double> x, std::span<double> y, std::span<double> z) {
        std::vector<double> u(x.size()), v(x.size()), w(x.size());
        axes.read(first, u, v, w);
        copy_block(linear[0], first, x);
        copy_block(linear[1], first, y);
        copy_block(linear[2], first, z);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3 shift = to_machine * (ball * (Vec3(u[i], v[i], w[i]) - Vec3::UnitZ()));
            x[i] += shift.x();
            y[i] += shift.y();
            z[i] += shift.z();
        }
    };
    set_columns(trajectory, make_columns(trajectory.count, compute));
}

Trajectory reconstruct_ball(const Log& log, Role role, const Eigen::Isometry3d& pose,
                            std::shared_ptr<const Kinematics> kinematics, double ball) {
    Trajectory trajectory = trajectory_of(log, role);
    trajectory.ball = ball;
    trajectory.set_pose(pose);
    for (std::size_t axis = 0; axis < 3; ++axis) trajectory.axes[axis] = linear_axis(log, role, "xyz"[axis]);
    if (kinematics == nullptr || !kinematics->has_rotary()) return trajectory;
    const AngleReader angles(log, role, *kinematics);
    const std::array<ChannelView, 3> linear = trajectory.axes;
    const auto compute = [&](PointIndex first, std::span<double> x, std::span<double> y, std::span<double> z) {
        std::vector<double> tilt(x.size()), rotation(x.size());
        angles.read(first, tilt, rotation);
        copy_block(linear[0], first, x);
        copy_block(linear[1], first, y);
        copy_block(linear[2], first, z);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const ToolPose at = kinematics->to_workpiece(Vec3(x[i], y[i], z[i]), {tilt[i], rotation[i]});
            const Vec3 tip = ball > 0 ? Vec3(at.tip + ball * (at.axis - Vec3::UnitZ())) : at.tip;
            x[i] = tip.x();
            y[i] = tip.y();
            z[i] = tip.z();
        }
    };
    set_columns(trajectory, make_columns(trajectory.count, compute));
    trajectory.kinematics = std::move(kinematics);
    return trajectory;
}

}  // namespace

Trajectory reconstruct(const Log& log, Role role, const Vec3& offset, std::shared_ptr<const Kinematics> kinematics) {
    return reconstruct_ball(log, role, Eigen::Isometry3d(Eigen::Translation3d(-offset)), std::move(kinematics), 0);
}

Trajectory reconstruct(const Log& log, Role role, const Eigen::Isometry3d& pose,
                       std::shared_ptr<const Kinematics> kinematics) {
    return reconstruct_ball(log, role, pose, std::move(kinematics), 0);
}

namespace {

Trajectory reconstruct_like(const Log& log, Role role, const Trajectory& like, double ball) {
    Trajectory trajectory = reconstruct_ball(log, role, like.pose(), like.kinematics, ball);
    trajectory.stated_axes = like.stated_axes;
    trajectory.axis_known = like.axis_known;
    if (trajectory.stated_axes != nullptr && ball > 0) use_upright_ball(trajectory, ball);
    return trajectory;
}

}  // namespace

Trajectory upright_ball(const Log& log, const Trajectory& like, double radius) {
    return reconstruct_like(log, like.role, like, radius);
}

bool tilts(const Log& log, const Trajectory& trajectory) {
    if (trajectory.kinematics == nullptr) return trajectory.stated_axes != nullptr;
    constexpr double tolerance = 1e-6;
    const Kinematics& kinematics = *trajectory.kinematics;
    return for_angles(log, AngleReader(log, trajectory.role, kinematics), [&](PointIndex, const RotaryAngles& angles) {
        return angle_between(kinematics.axis_of(angles), Vec3::UnitZ()) > tolerance;
    });
}

bool can_reconstruct_like(const Log& log, Role role, const Trajectory& like) {
    if (!log.has(role)) return false;
    if (!like.kinematics) return true;
    const auto has_axis = [&](const RotaryAxis& axis) {
        return log.find(std::string(prefix_of(role)) + "." + axis.letter) != nullptr;
    };
    return has_axis(like.kinematics->tilt) && has_axis(like.kinematics->rotation);
}

Trajectory reconstruct_like(const Log& log, Role role, const Trajectory& like) {
    return role == like.role ? like : reconstruct_like(log, role, like, like.ball);
}

ToolAxes tool_axes(const Log& log, Role role, const Trajectory& like) {
    if (like.stated_axes != nullptr) return *like.stated_axes;
    const Kinematics& kinematics = *like.kinematics;
    const AngleReader angles(log, role, kinematics);
    const auto compute = [&](PointIndex first, std::span<double> x, std::span<double> y, std::span<double> z) {
        angles.read(first, x, y);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3 axis = like.turn * kinematics.axis_of({x[i], y[i]});
            x[i] = axis.x();
            y[i] = axis.y();
            z[i] = axis.z();
        }
    };
    return ToolAxes(make_columns(log.records, compute));
}

ChannelView axis_angles(const Log& log, Role role, char letter) {
    ChannelView view = channel_of(log, role, letter).values;
    view.scale *= rad_per_deg;
    view.bias *= rad_per_deg;
    return view;
}

void note_poles(const Log& log, Role role, const Kinematics& kinematics, Diagnostics& diagnostics) {
    const double near = std::sin(2 * rad_per_deg);
    constexpr double much = 45 * rad_per_deg;
    bool inside = false;
    PointIndex since = 0;
    double low = 0, high = 0;
    const auto leave = [&] {
        if (inside && high - low > much) {
            diagnostics.add(
                {Severity::note,
                 "path.pole",
                 Place::of_point(log.name, since),
                 fmt::format("the tool axis passes its pole: within 2 deg of it axis {} turns by {:.1f} deg",
                             kinematics.rotation.letter, (high - low) * deg_per_rad),
                 {}});
        }
        inside = false;
    };
    (void)for_angles(log, AngleReader(log, role, kinematics), [&](PointIndex point, const RotaryAngles& angles) {
        if (!(kinematics.rotation.direction.cross(kinematics.axis_of({angles.tilt, 0})).norm() < near)) {
            leave();
            return false;
        }
        if (!inside) {
            inside = true;
            since = point;
            low = high = angles.rotation;
        }
        low = std::min(low, angles.rotation);
        high = std::max(high, angles.rotation);
        return false;
    });
    leave();
}

std::optional<RotaryMotion> find_rotary_motion(const Log& log, Role role) {
    constexpr double moving = 0.01 * rad_per_deg;
    std::vector<double> values;
    for (const char letter : {'a', 'b', 'c'}) {
        if (log.find(fmt::format("{}.{}", prefix_of(role), letter)) == nullptr) continue;
        const ChannelView view = axis_angles(log, role, letter);
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (PointIndex begin = 0; begin < view.count; begin += block_points) {
            values.resize(static_cast<std::size_t>(std::min(block_points, view.count - begin)));
            copy_block(view, begin, values);
            for (const double value : values) {
                low = value < low ? value : low;
                high = value > high ? value : high;
            }
        }
        if (high - low > moving) return RotaryMotion{letter, high - low};
    }
    return std::nullopt;
}

void note_rotary(const Log& log, Role role, Diagnostics& diagnostics) {
    const std::optional<RotaryMotion> motion = find_rotary_motion(log, role);
    if (!motion) return;
    diagnostics.add(
        {Severity::warning, "path.rotary", Place::of_file(log.name),
         fmt::format(
             "axis {} moves by {:.2f} deg: positions are those of the linear axes, not of the tool on the workpiece",
             motion->letter, motion->range * deg_per_rad),
         "give the kinematics with --machine FILE"});
}

Box3 box_of(const Trajectory& path) {
    std::vector<Box3> boxes(static_cast<std::size_t>((path.count + block_points - 1) / block_points));
    for_each_block(path.count, [&](PointIndex first, PointIndex last) {
        std::vector<double> x(static_cast<std::size_t>(last - first)), y(x.size()), z(x.size());
        path.read(first, x, y, z);
        Box3& box = boxes[static_cast<std::size_t>(first / block_points)];
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            if (p.allFinite()) box.extend(p);
        }
    });
    Box3 all;
    for (const Box3& box : boxes) all.extend(box);
    return all;
}

}  // namespace clsurf
