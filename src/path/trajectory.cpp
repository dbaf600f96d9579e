#include "path/trajectory.h"

#include "core/error.h"

namespace clsurf {

void Trajectory::read(PointIndex begin, std::span<double> x, std::span<double> y,
                      std::span<double> z) const {
    const std::array<std::span<double>, 3> out{x, y, z};
    for (int axis = 0; axis < 3; ++axis) {
        copy_block(axes[axis], begin, out[axis]);
        if (offset[axis] == 0.0) continue;
        for (double& value : out[axis]) value += offset[axis];
    }
}

Vec3 Trajectory::at(PointIndex point) const {
    return Vec3(axes[0].at(point), axes[1].at(point), axes[2].at(point)) + offset;
}

Trajectory reconstruct(const Log& log, Role role, const Vec3& offset) {
    Trajectory trajectory;
    trajectory.role = role;
    trajectory.offset = offset;
    trajectory.count = log.records;
    trajectory.period = log.period;
    trajectory.name = log.name;
    trajectory.keep_alive = log.keep_alive;
    const std::string prefix(prefix_of(role));
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name = prefix + "." + "xyz"[axis];
        const Channel* channel = log.find(name);
        if (channel == nullptr) {
            throw InputError(Place::of_file(log.name),
                             "no " + std::string(name_of(role)) + " positions: channel '" + name +
                                 "' is missing",
                             "`clsurf info` lists the channels that the log has");
        }
        trajectory.axes[static_cast<std::size_t>(axis)] = channel->values;
    }
    return trajectory;
}

}  // namespace clsurf
