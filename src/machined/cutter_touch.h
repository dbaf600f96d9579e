#pragma once
// CutterTouch: how far a place lies from the cutter itself, on its way from point to point of a log. It needs the
// tips and the tool alone, no normal of the part, so that it holds in hollows and at creases, where neighbouring
// passes tell no normal.
//
// The cutter is the body that its corner makes: all that lies no farther than the corner radius from the disc in
// which the corner's centres turn (a ball's is its centre alone). Above the corner it is no wall: what the shank
// might rub is not cut there. The distance to a convex body that moves straight is convex along the move.

#include <optional>
#include <utility>

#include "machined/tool.h"
#include "toolpath/tool_axes.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// The point of a piece of the path whose cutter comes nearest to a place.
struct CutterTouch {
    PointIndex point = -1;  ///< −1: none
    double distance = 0;    ///< [mm] to the cutter there or on the way to the next point; < 0: the place is cut away
    Vec3 projection = Vec3::Zero();  ///< [mm] of the place on the cutter
};

class CutterBody {
public:
    /// `axes`: nullopt: the tool axis is +z all the time.
    CutterBody(Trajectory path, std::optional<ToolAxes> axes, const CuttingTool& tool)
        : path_(std::move(path)), axes_(std::move(axes)), tool_(tool) {}

    /// Distance [mm] from the cutter to a place that lies `off` [mm] from its tip; < 0: inside.
    [[nodiscard]] double distance(const Vec3& off, const Vec3& axis) const;
    /// The least distance on the path's arc length through a point, from the one before to the next one, within `piece`.
    /// Names the nearest point to where it is.
    [[nodiscard]] CutterTouch touch(PointIndex point, PointRange piece, const Vec3& place) const;
    /// The lowest height [mm] of an upright cutter over the place's x, y on that way; infinite: it does not reach.
    [[nodiscard]] double lowest(PointIndex point, PointRange piece, const Vec3& place) const;

private:
    [[nodiscard]] Vec3 centre_near(const Vec3& off, const Vec3& axis) const;
    [[nodiscard]] Vec3 axis_at(PointIndex point) const { return axes_ ? axes_->at(point) : Vec3(Vec3::UnitZ()); }

    Trajectory path_;
    std::optional<ToolAxes> axes_;
    CuttingTool tool_;
};

}  // namespace clsurf
