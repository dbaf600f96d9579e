#pragma once
// ToolAxes: the direction of the tool at each point of a log, and the angles of single rotary axes.

#include <array>
#include <memory>
#include <span>

#include "core/column.h"
#include "core/geometry.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Unit vectors of the tool axis in the workpiece, from the tip to the spindle. Copies share them.
class ToolAxes {
public:
    using Columns = std::array<Column<double>, 3>;  ///< x, y, z

    explicit ToolAxes(std::shared_ptr<const Columns> columns) : columns_(std::move(columns)) {}

    [[nodiscard]] PointIndex count() const { return static_cast<PointIndex>(columns_->front().size()); }
    [[nodiscard]] Vec3 at(PointIndex point) const;
    /// Copies points [begin, begin + x.size()). All spans same size.
    void read(PointIndex begin, std::span<double> x, std::span<double> y, std::span<double> z) const;

private:
    std::shared_ptr<const Columns> columns_;
};

/// The tool axes of a role, brought into the workpiece as `like` was, which has kinematics, or those that `like` has stated.
/// Throws InputError where the log lacks the angles. O(points), parallel; 24 bytes a point.
[[nodiscard]] ToolAxes tool_axes(const Log& log, Role role, const Trajectory& like);

/// The angle of a rotary axis as the control counts it [rad]: a view of the log's column, which must outlive it. Throws
/// InputError where the log does not have it.
[[nodiscard]] ChannelView axis_angles(const Log& log, Role role, char letter);

}  // namespace clsurf
