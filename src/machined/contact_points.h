#pragma once
// ContactPoints: where the tool touches the part, for each point of a log.
//
// The normal of the part at the contact is computed from the tool's own positions. Along the pass it uses a chord of one
// step-over; across it, both adjacent passes at three places of the chord. At an outermost pass the direction across is
// extrapolated from the passes on the other side. A point without an adjacent pass gets the normal of the nearest points on its
// path that have one, made perpendicular to its own feed.
//
// With an upright tool, the surface of its tips has the normal of the part. With a tool that turns it does not, because the
// touching point of the torus also moves with the rigid tool. Let n be the normal of the part, a the tool axis, c the corner
// radius, R the radius of the tool and e the direction of n across a. For fixed n, the points tip + c a − (R − c) e of all
// positions form a surface whose normal there is n. This is solved by iteration. For a ball (R = c) this is the surface of its
// centres.
//
// Nothing is stored per point: each contact point is computed when it is requested.

#include <optional>
#include <vector>

#include "machined/tool.h"
#include "surface/cl_surface.h"
#include "surface/path_location.h"
#include "toolpath/tool_axes.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Whether a link between passes stays low enough to cut: no more than a step-over above its ends. O(its points).
[[nodiscard]] bool stays_low(const Positions& positions, const Pass& link, double step_over);

class ContactPoints {
public:
    /// `surface`: made from the positions of `path`; it must outlive this. `axes`: nullopt: the tool axis is always +z.
    /// O(passes).
    ContactPoints(const ClSurface& surface, const Trajectory& path, std::optional<ToolAxes> axes,
                  const CuttingTool& tool);

    /// The contact point in the workpiece [mm]; nullopt if the tool does not finish there, or no pass is near enough for a
    /// normal. O(points in two step-overs of the pass).
    [[nodiscard]] std::optional<Vec3> at(PointIndex point) const;
    /// Unit normal of the part where the tool touches it; NaN: not known.
    [[nodiscard]] Vec3 normal(PointIndex point) const;
    [[nodiscard]] const CuttingTool& tool() const { return tool_; }
    /// nullopt: always +z.
    [[nodiscard]] const std::optional<ToolAxes>& axes() const { return axes_; }
    /// Largest distance of a contact point from its tip [mm].
    [[nodiscard]] double reach() const;
    /// Whether a piece of the path can have contact points.
    [[nodiscard]] bool cuts(const Pass& piece) const;

private:
    /// Places on the path that give a direction at one place.
    struct Direction {
        PathLocation from, to;         ///< the direction is from → to …
        PathLocation before, towards;  ///< … or, at a border, extrapolated from before → towards
    };
    /// The directions along the pass of a point and across it, which give its normal.
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
    double level_ = 0;       ///< sine of the tilt below which the whole flat bottom touches the part
};

}  // namespace clsurf
