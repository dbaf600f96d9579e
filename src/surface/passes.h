#pragma once
// Passes: the trajectory cut into pieces. A pass is a maximal run of cutting points whose neighbour passes are to the
// side, not ahead; links and rapids join passes.
//
// Runs follow from the program (cutting or not). Within a run the path turns back where the chords before and after a
// point enclose more than 120°; such a section links two passes. The chord is an arc length (1.5 step-overs), not a
// number of samples, so that it bridges both corners of a step-over move at any speed. Loops and spirals do not turn
// back: they are cut where the neighbour of a point is in its own pass (surface/cl_surface.h).

#include <cstdint>
#include <span>

#include "core/column.h"
#include "core/point.h"
#include "core/point_ranges.h"
#include "mapping/line_map.h"
#include "toolpath/arc_length.h"
#include "toolpath/positions.h"

namespace clsurf {

/// `other` is cutting that does not finish a surface: pockets, drilling, single contours (surface/finishing.h).
enum class PassKind : std::uint8_t { cut, link, rapid, other };

/// Whether the surface has points of this kind.
[[nodiscard]] constexpr bool is_of_surface(PassKind kind) { return kind == PassKind::cut || kind == PassKind::link; }

struct Pass {
    PointIndex first = 0;
    PointIndex last = -1;  ///< inclusive
    PassKind kind = PassKind::cut;
    [[nodiscard]] PointIndex size() const { return last - first + 1; }
};

/// All pieces in order; together they cover every point of the trajectory exactly once.
using Passes = Column<Pass>;

/// Appends a piece, unless it is empty; joins it with the previous one if both are of the same kind.
void append_pass(Passes& passes, Pass piece);

/// The number of the piece that contains a point. O(log passes).
[[nodiscard]] inline std::size_t pass_of(const Passes& passes, PointIndex point) {
    return static_cast<std::size_t>(range_at(passes, point) - passes.begin());
}

/// How many points cut. O(passes).
[[nodiscard]] inline PointIndex cutting_points(std::span<const Pass> passes) {
    PointIndex points = 0;
    for (const Pass& pass : passes) points += pass.kind == PassKind::cut ? pass.size() : 0;
    return points;
}

/// One cut of `count` points: for statistics over all values of a field without passes.
[[nodiscard]] inline Passes as_one_pass(PointIndex count) { return Passes(1, Pass{0, count - 1, PassKind::cut}); }

/// Cutting runs and the points between them. A vertical approach or retract at the ends of a run, and points without
/// a position, are not cutting. O(points), parallel.
[[nodiscard]] Passes find_runs(const Positions& positions, const LineMap& lines);

/// Runs cut into passes at reversals of direction, for a step-over [mm] > 0; links between. O(points), parallel.
[[nodiscard]] Passes find_passes(const Positions& positions, const ArcLength& lengths, const Passes& runs,
                                 double step_over);

}  // namespace clsurf
