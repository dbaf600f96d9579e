#pragma once
// CutterTouch: the distance of a place from the cutter on its path from point to point of a log. It depends on the tips and the
// tool only, not on a normal of the part, so it is valid in hollows and at creases, where adjacent passes give no normal.
//
// The cutter is the body of its corner: all places no farther than the corner radius from the disc of the corner's centres (for
// a ball, from its centre). Above the corner it has no wall, because the shank does not cut. The distance to a convex body that
// moves along a straight line is convex along the motion.

#include <optional>
#include <utility>

#include "machined/tool.h"
#include "toolpath/tool_axes.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// The point of a section of the path whose cutter is nearest to a place.
struct CutterTouch {
    PointIndex point = -1;  ///< −1: none
    double distance = 0;    ///< [mm] to the cutter there or on the motion to the next point; < 0: the place is cut away
    Vec3 projection = Vec3::Zero();  ///< [mm] of the place onto the cutter
};

class CutterBody {
public:
    /// `axes`: nullopt: the tool axis is always +z.
    CutterBody(Trajectory path, std::optional<ToolAxes> axes, const CuttingTool& tool)
        : path_(std::move(path)), axes_(std::move(axes)), tool_(tool) {}

    /// Distance [mm] from the cutter to a place at `off` [mm] from its tip; < 0: inside.
    [[nodiscard]] double distance(const Vec3& off, const Vec3& axis) const;
    /// The least distance on the path through a point, from the point before to the next one, within `piece`. Gives the point
    /// nearest to that place.
    [[nodiscard]] CutterTouch touch(PointIndex point, PointRange piece, const Vec3& place) const;
    /// The lowest height [mm] of an upright cutter above the place's x, y on the same motions; infinite: it does not reach it.
    [[nodiscard]] double lowest(PointIndex point, PointRange piece, const Vec3& place) const;

private:
    [[nodiscard]] Vec3 centre_near(const Vec3& off, const Vec3& axis) const;
    [[nodiscard]] Vec3 axis_at(PointIndex point) const { return axes_ ? axes_->at(point) : Vec3(Vec3::UnitZ()); }

    Trajectory path_;
    std::optional<ToolAxes> axes_;
    CuttingTool tool_;
};

}  // namespace clsurf
