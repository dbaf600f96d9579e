#pragma once
// What blocks leave to the next one besides modes: how arcs are given, open splines, corners to cut; and what holds for one
// block alone.

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"

namespace clsurf {

/// How arcs are given: usually, or as Heidenhain's G05, by Siemens' CIP, or by its CT and Heidenhain's G06.
enum class ArcKind : std::uint8_t { usual, by_radius, by_points, tangential };

struct ArcState {
    ArcKind kind = ArcKind::usual;
    bool polar_line = false;  ///< Heidenhain's G10 … G16: R and H give the end
    bool last_clockwise = false;
    Vec3 begin_of_last = Vec3::Zero();  ///< where the last motion began [mm], of the work system
};

struct CurveState {
    std::vector<Vec3> nurbs;  ///< x, y, weight
    int nurbs_order = 3;
    Vec2 spline_out = Vec2::Zero();  ///< P Q of the cubic spline before
};

/// A corner that the next line cuts off: RND, CHF.
struct Corner {
    bool pending = false;
    bool rounded = false;  ///< else a chamfer
    double size = 0;       ///< radius, or length taken off each line [mm]
    double feed = 0;       ///< as programmed
    LineNumber line = 0;
};

struct BlockFlags {
    bool machine_coordinates = false;  ///< G53, SUPA
    bool motion_suppressed = false;    ///< the axis words belong to G10, G92, G28 …
    bool path_mode_returns = false;    ///< G9: the mode in force comes back behind the block
    std::string unknown_name;          ///< of a variable of the control that the block has read
    int unknown_parameter = 0;         ///< that the block has read
};

}  // namespace clsurf
