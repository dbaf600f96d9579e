#pragma once
// Arcs of G2 and G3: I J K or R, turns and planes → centre and turns; the radius check.
// Rules: RS274/NGC, section 3.5.3.

#include <cstdint>
#include <string>

#include "core/geometry.h"
#include "program/dialects/dialect.h"
#include "program/motion.h"

namespace clsurf {

struct ArcWords {
    Vec3 begin, end;  ///< [mm]; the components along `axis` make it a helix
    int axis = 2;     ///< of rotation
    bool clockwise = false;
    bool has_radius = false;
    double radius = 0;  ///< [mm]; negative: the arc of more than 180°
    Vec3 centre;        ///< [mm], absolute; unless has_radius
    int turns = 1;      ///< full circles + 1
};

/// How far the radii of an arc at its start and at its end may differ. They are refused where the difference is
/// more than `most`, or more than both `absolute` and `relative` times the greater radius.
struct ArcTolerance {
    double absolute = 0;        ///< [mm]
    double relative = 0;        ///< of the greater radius
    double most = 0;            ///< [mm]
    double reach = 0;           ///< by which half the chord may exceed a radius R [mm]
    double relative_reach = 0;  ///< the same, of R; the greater of both counts
    bool moves_centre = false;  ///< the centre is moved so that one circle runs through both ends; else a spiral
};

/// What the controls of a dialect accept. `unit_mm`: of the program's lengths.
[[nodiscard]] ArcTolerance arc_tolerance(DialectId dialect, double unit_mm);

/// The arc, without its motion's number; or, in `error`, why there is none (both radii named).
[[nodiscard]] Arc resolve_arc(const ArcWords& words, const ArcTolerance& tolerance, std::string& error);

/// Way along an arc or helix [mm].
[[nodiscard]] double arc_length(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end);

}  // namespace clsurf
