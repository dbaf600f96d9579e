#pragma once
// Deviation: the distance between the paths of two programs and the angle between their tool axes, measured
// along the whole of both.

#include "program/program.h"
#include "repair/points/orientation.h"

namespace clsurf {

/// A line of either program.
struct LineOfEither {
    LineNumber line = 0;
    bool of_first = false;
};

struct Deviation {
    // The same as in docs/experiments/repair.md#the-search-in-detail, Deviation.
    static constexpr double usual_step = 0.05;  ///< [mm] of arc length between measured points

    double greatest = 0;           ///< [mm]
    LineOfEither line;             ///< of the program that is farthest from the other there
    Vec3 position = Vec3::Zero();  ///< [mm] place of the largest distance
    double turned = 0;             ///< [rad] greatest angle between the tool axes
    LineOfEither turned_line;      ///< there
    /// The line of the second program with the first rapid, dwell, arc or rotation in place that differs between both, or with
    /// a path on which an axis differs by more than a quarter turn; its last line if the second program has fewer of them; 0:
    /// all agree.
    LineNumber disordered = 0;
};

/// The tool axes of two programs that run on five axes; nullptr: three axes.
struct Orientations {
    const Orientation *before = nullptr, *after = nullptr;
};

/// Compares both paths in both directions: the ends of motions of each path and points every `step` [mm] between them (on five
/// axes also every degree of rotation) are measured against the other path within a millimetre of the present position. A
/// missing pass causes a deviation of at least one step-over. The tool axes compared are those of the controller there and at
/// the nearest place of the other path; if there are several, for example before and after a rotation in place, the most
/// similar one counts. Motions as for simulate_five_axis(). O(arc length / step).
[[nodiscard]] Deviation measure_deviation(const Program& before, const Program& after,
                                          double step = Deviation::usual_step, const Orientations& orientations = {});

}  // namespace clsurf
