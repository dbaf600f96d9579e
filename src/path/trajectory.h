#pragma once
// Trajectory: workpiece positions of one role, read by block. For three axes it stores nothing: it is
// an offset over the log's columns.

#include <array>
#include <memory>
#include <span>
#include <string>

#include "core/channel_view.h"
#include "core/geometry.h"
#include "log/log.h"

namespace clsurf {

struct Trajectory {
    Role role = Role::commanded;
    std::array<ChannelView, 3> axes;  ///< machine positions x, y, z [mm]
    Vec3 offset = Vec3::Zero();       ///< workpiece = machine + offset [mm]
    PointIndex count = 0;
    double period = 0;  ///< [s]
    std::string name;   ///< of the log, for messages
    std::shared_ptr<const void> keep_alive;

    /// Gathers points [begin, begin + x.size()); NaN where the log has none. All spans same size.
    void read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const;
    [[nodiscard]] Vec3 at(PointIndex point) const;
};

/// The positions of one role of a three-axis log: work offset and tool length as `offset` [mm].
/// Throws InputError when the log has no such role.
[[nodiscard]] Trajectory reconstruct(const Log& log, Role role, const Vec3& offset);

}  // namespace clsurf
