#pragma once
// Deviation: how far two programs' paths lie apart, measured on the whole of both.

#include "program/program.h"

namespace clsurf {

struct Deviation {
    double greatest = 0;           ///< [mm]
    LineNumber line = 0;           ///< of the second program, there
    Vec3 position = Vec3::Zero();  ///< [mm] there
    /// The line (of the second program) of the first rapid, dwell, arc or motion of a rotary axis that is not
    /// the same in both; its last line where the second has fewer; 0: all are the same.
    LineNumber disordered = 0;
};

/// Both paths are walked side by side, forth and back: from each, the ends of motions and points every
/// `step` [mm] between are measured against the other one within a millimetre of where the walk has come
/// to; a pass that was left out shows as a step-over at least. O(way / step).
[[nodiscard]] Deviation measure_deviation(const Program& before, const Program& after, double step = 0.05);

}  // namespace clsurf
