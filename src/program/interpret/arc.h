#pragma once
// Arcs of G2 and G3: I J K or R, turns and planes → centre and turns; the radius check.
// Rules: RS274/NGC, section 3.5.3.

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry.h"
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

/// How much the radii of an arc at its start and at its end may differ. An arc is refused if the difference exceeds
/// `most`, or exceeds both `absolute` and `relative` times the greater radius.
struct ArcTolerance {
    double absolute = 0;        ///< [mm]
    double relative = 0;        ///< of the greater radius
    double most = 0;            ///< [mm]
    double reach = 0;           ///< greatest excess of half the chord over a radius R [mm]
    double relative_reach = 0;  ///< the same, relative to R; the greater one counts
    bool moves_centre = false;  ///< the centre is moved so that one circle passes through both ends; else a spiral
};

/// The arc, without its motion's number; if there is none, the reason in `error` (with both radii).
[[nodiscard]] Arc resolve_arc(const ArcWords& words, const ArcTolerance& tolerance, std::string& error);

/// Angle of an arc about its axis, always positive [rad].
[[nodiscard]] double arc_sweep(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end);

/// Arc length along an arc or helix [mm].
[[nodiscard]] double arc_length(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end);

constexpr double arc_chord_error = 1e-3;  ///< [mm] error of the chords that replace an arc

/// How many equal chords stay within `error` [mm] of an arc, helix or spiral of that sweep [rad] and greatest radius
/// [mm]; at most 100,000. `widening`: the change of a spiral's radius [mm].
[[nodiscard]] int chord_count(double radius, double sweep, double widening, double error = arc_chord_error);

/// An arc, helix or spiral as chords: their ends, at equal parts of the arc. The last one is `end` itself.
[[nodiscard]] std::vector<Vec3> arc_chords(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end,
                                           double error = arc_chord_error);

}  // namespace clsurf
