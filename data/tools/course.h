#pragma once
// Courses: tool paths of many shapes on many surfaces, as closely spaced points with surface normals, for logs with
// planted defects (kinds.h).
//
// A course is laid out on a plane (u along a pass, v across) and mapped onto its surface: a height field, a steep wall, or a
// tower. Contours around islands are level lines of the distance to the nearest border, traced on a grid.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace clsurf::planted {

enum class Layout : std::uint8_t {
    zigzag,       ///< straight passes back and forth
    one_way,      ///< straight passes, a retract after each
    oblique,      ///< a zigzag at an angle to the axes
    arcs,         ///< concentric arcs back and forth
    interrupted,  ///< a zigzag with retracts over an island
    contours,     ///< closed loops inwards from the border of a rectangle
    islands,      ///< closed loops inwards from a rectangle and around two islands, with rounded creases in between
    spiral,       ///< from outside inwards
    waterline,    ///< closed loops around a tower, level by level
    staggered,    ///< the same with slanted links, each farther along the loop than the previous one
    slanted,      ///< the same with links of 3.4 mm that begin before the loop closes
    helix,        ///< the same as one continuous turn
    wall,         ///< a zigzag on a steep wall, from level to level
    triangles,    ///< closed loops with sharp corners inwards from the border of a triangle, joined by straight moves
};
inline constexpr int layouts = 14;
[[nodiscard]] std::string_view name_of(Layout layout);

struct CourseRecipe {
    Layout layout = Layout::zigzag;
    double length = 30;      ///< [mm] length of a straight pass; side or diameter of other layouts
    int passes = 30;         ///< number of passes; for contours the maximum
    double step_over = 0.3;  ///< [mm]
    double angle = 0.5;      ///< [rad] angle of oblique passes
    double waviness = 1;     ///< [mm] amplitude of the surface
    double wave = 12;        ///< [mm] its wavelength / 2π
    double draft = 0.1;      ///< [rad] angle of walls and towers from the vertical
    double spacing = 0.02;   ///< [mm] distance between points
    double block = 0.5;      ///< [mm] programmed step
};

enum class Motion : std::uint8_t { cut, link, rapid };

struct CoursePoint {
    Vec3 at = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();  ///< normal of the surface
    int pass = -1;                ///< from 0; −1: on a link or a rapid
    Motion motion = Motion::cut;  ///< motion to the point
};

/// The points of a course in order of motion. Each pass is contiguous.
[[nodiscard]] std::vector<CoursePoint> lay_course(const CourseRecipe& recipe);

}  // namespace clsurf::planted
