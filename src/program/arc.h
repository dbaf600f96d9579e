#pragma once
// Arcs of G2 and G3: I J K or R, turns and planes → centre and turns; the radius check.
// Rules: RS274/NGC, section 3.5.3; tolerances as LinuxCNC has them.

#include <cstdint>
#include <string>

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

/// The arc, without its motion's number; or, in `error`, why there is none (both radii named).
[[nodiscard]] Arc resolve_arc(const ArcWords& words, std::string& error);

/// Way along an arc or helix [mm].
[[nodiscard]] double arc_length(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end);

}  // namespace clsurf
