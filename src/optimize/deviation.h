#pragma once
// Deviation: how far two programs' paths lie apart, and how far their tools point apart, measured on the whole of both.

#include "optimize/orientation.h"
#include "program/program.h"

namespace clsurf {

struct Deviation {
    static constexpr double usual_step = 0.05;  ///< [mm] of way between measured points

    double greatest = 0;           ///< [mm]
    LineNumber line = 0;           ///< of the second program, there
    Vec3 position = Vec3::Zero();  ///< [mm] there
    double turned = 0;             ///< [rad] greatest angle between the tool axes
    LineNumber turned_line = 0;    ///< of the second program, there
    /// The line (of the second program) of the first rapid, dwell, arc or turn in place that is not
    /// the same in both, or of a way on which the axes are turned by more than a quarter turn else; its last line where the
    /// second has fewer; 0: all are the same.
    LineNumber disordered = 0;
};

/// Where the tools of two programs that are run on five axes point; nullptr: three axes.
struct Orientations {
    const Orientation *before = nullptr, *after = nullptr;
};

/// Both paths are walked side by side, forth and back: from each, the ends of motions and points every
/// `step` [mm] between (on five axes every degree of turn as well) are measured against the other one within a millimetre
/// of where the walk has come to; a pass that was left out shows as a step-over at least. Tool axes are those that the
/// controller has there and at the nearest place of the other path; where there are several, as before and behind a
/// turn in place, the one that fits. Motions as simulate_five_axis() wants them. O(way / step).
[[nodiscard]] Deviation measure_deviation(const Program& before, const Program& after,
                                          double step = Deviation::usual_step, const Orientations& orientations = {});

}  // namespace clsurf
