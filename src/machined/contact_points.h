#pragma once
// ContactPoints: where the tool touches the part, point by point of a log.
//
// The normal of the part at the contact comes from the tool's own positions: along the pass from a chord of
// one step-over, across it from both passes beside it at three places of the chord. At an outermost pass it is
// carried on from the passes on its one side. Where a point has no pass beside it, the normal is that of the
// nearest points on its path which have one, made square to its own feed.
//
// With an upright tool the surface of its tips has the part's normal. A tool that turns has not: a point of the
// torus that touches moves as the rigid tool does. With n the part's normal, a the tool axis, c the corner
// radius, R the tool's and e the direction of n across a, the points tip + c a − (R − c) e of all positions, for
// one n, form a surface whose normal there is n. That is solved by iteration. For a ball (R = c) this is the
// surface of its centres.
//
// Nothing is kept per point: each contact point is computed when it is asked for.

#include <optional>
#include <vector>

#include "machined/tool.h"
#include "surface/cl_surface.h"
#include "surface/path_location.h"
#include "toolpath/tool_axes.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Whether a link between passes stays where it can cut: no more than a step-over above its ends. O(its points).
[[nodiscard]] bool stays_low(const Positions& positions, const Pass& link, double step_over);

class ContactPoints {
public:
    /// `surface` is that of the positions of `path`, and must outlive it. `axes`: nullopt: the tool axis is +z all the
    /// time. O(passes).
    ContactPoints(const ClSurface& surface, const Trajectory& path, std::optional<ToolAxes> axes,
                  const CuttingTool& tool);

    /// [mm] in the workpiece; nothing where the tool does not finish, or no pass is near that tells the normal.
    /// O(points in two step-overs of the pass).
    [[nodiscard]] std::optional<Vec3> at(PointIndex point) const;
    /// Unit normal of the part where the tool touches it; NaN: not known.
    [[nodiscard]] Vec3 normal(PointIndex point) const;
    [[nodiscard]] const CuttingTool& tool() const { return tool_; }
    /// nullopt: +z all the time.
    [[nodiscard]] const std::optional<ToolAxes>& axes() const { return axes_; }
    /// No contact point lies farther from its tip [mm].
    [[nodiscard]] double reach() const;
    /// Whether a piece of the path can have contact points.
    [[nodiscard]] bool cuts(const Pass& piece) const;

private:
    /// Places on the path that tell a direction at one place.
    struct Direction {
        PathLocation from, to;         ///< it is from → to …
        PathLocation before, towards;  ///< … carried on from before → towards, where that exists: at a border
    };
    /// What tells the normal at a point: the directions along its pass and across it.
    struct Frame {
        Direction along;
        std::vector<Direction> across;
    };
    [[nodiscard]] const Pass* pass_of(PointIndex point) const;
    [[nodiscard]] PointIndex walk(PointIndex point, PointRange within, double distance) const;
    [[nodiscard]] std::optional<Direction> across_at(PointIndex point, const Eigen::Vector3f& feed) const;
    [[nodiscard]] Frame make_frame(PointIndex point, PointRange pass) const;
    [[nodiscard]] Vec3 normal_by_neighbours(PointIndex point, PointRange pass) const;
    [[nodiscard]] Vec3 normal_from_along(PointIndex point, PointRange piece) const;
    [[nodiscard]] Vec3 axis_at(const PathLocation& at) const;
    [[nodiscard]] Vec3 tool_point(const PathLocation& at, const Vec3& normal) const;

    const ClSurface& surface_;
    Trajectory path_;
    std::optional<ToolAxes> axes_;
    CuttingTool tool_;
    double half_chord_ = 0;  ///< [mm]
    double level_ = 0;       ///< sine of the tilt below which a flat bottom lies on the part with all of itself
};

}  // namespace clsurf
