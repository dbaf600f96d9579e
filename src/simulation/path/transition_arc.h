#pragma once
// The circular arc that replaces a corner. It is tangent to both blocks, its distance from the corner is at most the
// contour error, and it replaces at most a share of each block.
//
// After Li et al. 2025 (Eqs. 5, 6) and Shao 2022 (Eqs. 2 … 21), who use the tangent of a given arc; here the arc itself is
// used. With the deflection α between lines: e = l tan(α/4), r = l / tan(α/2). In general a circle touches the blocks in Q0
// and Q2 if its chord has the same angle to both tangents, (Q2 − Q0) · (t0 − t2) = 0. Its radius is then |Q2 − Q0| / (2
// sin(φ/2)), where φ is the angle between the tangents.

#include <cstdint>

#include "core/geometry.h"
#include "simulation/path/path_element.h"

namespace clsurf {

enum class CornerKind : std::uint8_t {
    arc,
    collinear,   ///< turns by less than 0.01°: needs no arc
    reversal,    ///< turns by more than 179°: can have no arc
    degenerate,  ///< a block without length
    none,  ///< no circle is tangent to both within its shares: the blocks are in no plane or almost without length
};

/// What limits the size of an arc.
enum class ArcLimit : std::uint8_t { error, length };

struct TransitionArc {
    CornerKind kind = CornerKind::degenerate;
    double deflection = 0;  ///< at the corner [rad]
    ArcLimit limited = ArcLimit::error;
    double arc_length_before = 0,
           arc_length_after = 0;   ///< lengths of the blocks that it replaces, from the corner [mm]
    double radius = 0, error = 0;  ///< r; distance of the corner from the arc [mm]
    double sweep = 0;              ///< angle between its tangents [rad]
    Vec3 begin = Vec3::Zero(), middle = Vec3::Zero(), end = Vec3::Zero(), centre = Vec3::Zero();
    Vec3 tangent = Vec3::Zero();  ///< at its start, unit

    [[nodiscard]] PathElement element() const;
};

/// The greatest arc between two blocks that meet; `before` ends where `after` begins. The arc is at most `error` from the
/// corner [mm] and replaces at most half of each block.
[[nodiscard]] TransitionArc transition_arc(const PathElement& before, const PathElement& after, double error);

/// Radius of the arc between two lines whose distance from their corner is `error` [mm].
[[nodiscard]] double radius_at_error(double deflection, double error);

}  // namespace clsurf
