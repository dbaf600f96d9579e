#pragma once
// State that blocks pass to the next one besides modes: the form of arcs and open splines; and flags of a single block.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"

namespace clsurf {

/// The form of arcs: usual, Heidenhain's G05, Siemens' CIP, or Siemens' CT and Heidenhain's G06.
enum class ArcKind : std::uint8_t { usual, by_radius, by_points, tangential };

struct ArcState {
    ArcKind kind = ArcKind::usual;
    bool polar_line = false;  ///< Heidenhain's G10 … G16: R and H give the end
    bool last_clockwise = false;
    Vec3 begin_of_last = Vec3::Zero();  ///< start of the last motion [mm], in the work system
};

/// A spline whose points come block by block.
enum class SplineKind : std::uint8_t {
    none,
    uniform,  ///< G5.2: control points, uniform knots
    knotted,  ///< G6.2: control points with their knots
    basis,    ///< BSPLINE: control points, intervals of knots
    akima,    ///< ASPLINE: points on the curve
    cubic,    ///< CSPLINE: points on the curve
};

/// The condition at an end of a spline through points.
enum class SplineEnd : std::uint8_t {
    free,     ///< BAUTO, EAUTO
    natural,  ///< BNAT, ENAT: no curvature
    tangent,  ///< BTAN, ETAN: in the direction of the adjacent motion
};

struct SplinePoint {
    Vec3 at = Vec3::Zero();  ///< [mm], of the work system
    double weight = 1;
    double knot = std::numeric_limits<double>::quiet_NaN();  ///< of G6.2; of BSPLINE the interval PL; NaN: not given
    LineNumber line = 0;
    double feed = 0;  ///< as programmed
};

struct OpenSpline {
    SplineKind kind = SplineKind::none;
    int degree = 3;
    std::vector<SplinePoint> points;
    std::vector<double> last_knots;  ///< knots of blocks without a point, after the knots of the points
    Vec3 begin_tangent = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< NaN: there is none
    SplineEnd begin = SplineEnd::tangent, end = SplineEnd::tangent;
    std::vector<std::size_t> events;  ///< number of points before each event within the spline
    bool left = false;                ///< a block in another mode came after it: the next point begins a new one
};

struct CurveState {
    OpenSpline open;
    Vec2 spline_out = Vec2::Zero();                                  ///< P Q of the previous cubic spline
    SplineEnd begin = SplineEnd::tangent, end = SplineEnd::tangent;  ///< active
    int degree = 3;                                                  ///< SD

    [[nodiscard]] bool is_open() const { return open.kind != SplineKind::none; }
};

struct CycleState {
    static constexpr double not_yet = std::numeric_limits<double>::quiet_NaN();
    double r = not_yet, z = not_yet, q = 0;  ///< modal words, as programmed
    /// R and bottom at the block that programmed them [mm]. RS274 instead evaluates the words again in each block.
    double r_height = not_yet, bottom = not_yet;
    Vec3 ijk = Vec3::Zero();   ///< of G87: the lateral offset, and the height to bore to, as programmed
    double p = 0;              ///< dwell [s]
    double initial = not_yet;  ///< level at the beginning of the cycle [mm]
};

struct BlockFlags {
    bool machine_coordinates = false;  ///< G53, SUPA
    bool motion_suppressed = false;    ///< the axis words belong to G10, G92, G28 …
    bool probes = false;               ///< G31: the motion is a probing move
    bool path_mode_returns = false;    ///< G9: the previous mode is restored after the block
    std::string unknown_name;          ///< name of a variable of the control that the block has read
    int unknown_parameter = 0;         ///< number of a parameter that the block has read
};

}  // namespace clsurf
