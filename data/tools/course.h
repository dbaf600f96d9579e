#pragma once
// Courses: tool paths of many shapes over many surfaces, as dense points with their surface normals, for logs with
// planted defects (kinds.h).
//
// A course is laid out on a plane (u along a pass, v across) and mapped onto its surface: a height field, a steep wall, or a
// tower. Contours round islands are level lines of the distance to the nearest border, traced on a grid.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace clsurf::planted {

enum class Layout : std::uint8_t {
    zigzag,       ///< straight passes to and fro
    one_way,      ///< straight passes, a retract after each
    oblique,      ///< a zigzag at an angle to the axes
    arcs,         ///< concentric arcs to and fro
    interrupted,  ///< a zigzag with retracts over an island
    contours,     ///< closed loops from the border of a rectangle inwards
    islands,      ///< closed loops from the border of a rectangle and round two islands, which meet in rounded creases
    spiral,       ///< from outside inwards
    waterline,    ///< closed loops round a tower, level by level
    staggered,    ///< the same, each level joined on a slant, farther on than the one before
    slanted,      ///< the same, over links of 3.4 mm that begin before the loop closes
    helix,        ///< the same as one continuous turn
    wall,         ///< a zigzag on a steep wall, level above level
    triangles,  ///< closed loops with sharp corners from the border of a triangle inwards, each joined straight sideways
};
inline constexpr int layouts = 14;
[[nodiscard]] std::string_view name_of(Layout layout);

struct CourseRecipe {
    Layout layout = Layout::zigzag;
    double length = 30;      ///< [mm] of a straight pass; side or diameter of what is round
    int passes = 30;         ///< of contours no more than there is room for
    double step_over = 0.3;  ///< [mm]
    double angle = 0.5;      ///< [rad] of oblique passes
    double waviness = 1;     ///< [mm] amplitude of the surface
    double wave = 12;        ///< [mm] its wavelength / 2π
    double draft = 0.1;      ///< [rad] of walls and towers against the vertical
    double spacing = 0.02;   ///< [mm] between dense points
    double block = 0.5;      ///< [mm] programmed step
};

enum class Motion : std::uint8_t { cut, link, rapid };

struct CoursePoint {
    Vec3 at = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();  ///< of the surface
    int pass = -1;                ///< from 0; −1: on a link or a rapid
    Motion motion = Motion::cut;  ///< with which it is reached
};

/// The points of a course in the order of their motion. Each pass lies in one piece.
[[nodiscard]] std::vector<CoursePoint> lay_course(const CourseRecipe& recipe);

}  // namespace clsurf::planted
