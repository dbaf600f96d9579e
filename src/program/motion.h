#pragma once
// Motions: the commanded toolpath as columns, one entry per motion, in the order in which the
// controller runs them (subprograms and loops unrolled).
//
// Positions are in the *active work coordinate system*, in mm, as the program gives them after
// G20/21, G90/91 and G92/G52; place_motions() (frame_placement.h) brings those of several such systems into one.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/column.h"
#include "core/geometry.h"
#include "core/point.h"
#include "numeric/bezier_curve.h"
#include "program/work_frame.h"

namespace clsurf {

enum class MotionKind : std::uint8_t { rapid, feed, cw, ccw, dwell, spline };

[[nodiscard]] constexpr bool is_arc(MotionKind kind) { return kind == MotionKind::cw || kind == MotionKind::ccw; }

/// Whether it can be curved.
[[nodiscard]] constexpr bool is_curved(MotionKind kind) { return is_arc(kind) || kind == MotionKind::spline; }

/// Whether the tool moves at feed.
[[nodiscard]] constexpr bool is_cut(MotionKind kind) { return kind != MotionKind::rapid && kind != MotionKind::dwell; }

/// A circle or helix: its centre and its plane.
struct Arc {
    std::int64_t motion = 0;  ///< index of its motion
    Xyz centre;               ///< [mm]; the component along the axis is that of the start
    std::int32_t turns = 1;   ///< 1: at most a full circle; n: n − 1 full circles more
    std::uint8_t axis = 2;    ///< axis of rotation: 2 z (G17), 1 y (G18), 0 x (G19)
};

/// A span of a spline. It begins at the beginning of its motion.
struct Curve {
    std::int64_t motion = 0;  ///< index of its motion
    std::shared_ptr<const BezierCurve> span;
};

/// A call of a subprogram, from one line and with one chain of callers.
struct Call {
    std::uint32_t caller = 0;  ///< the calling call: index into Motions::calls, from 1; 0: the main program
    std::uint16_t file = 0;    ///< of the calling line
    LineNumber line = 0;       ///< the calling line
};

struct Motions {
    Column<MotionKind> kind;
    Column<Xyz> end;  ///< [mm]; NaN: this axis has not been programmed yet
    /// [mm/s] along the path, [deg/s] if only rotary axes are programmed to move; rapid: NaN; dwell: its time [s].
    Column<float> feed;
    Column<LineNumber> line;  ///< line in the file of the motion
    /// A, B, C [rad]; empty if the program has no rotary axis; NaN while a tool axis, programmed as a vector,
    /// determines it, or after such a motion.
    Column<Xyz> rotary;
    Column<Xyz> tool_axis;       ///< programmed as a unit vector; NaN: given by the angles; empty: always given by them
    Column<std::uint16_t> file;  ///< index into Program::files; empty if all is in the main file
    Column<std::uint32_t> call;  ///< the active call: index into calls, from 1; 0: none; empty if nothing is called
    Column<std::uint32_t> frame;                 ///< index into frames; empty: all are in the first one
    std::vector<WorkFrame> frames{WorkFrame{}};  ///< at least one
    /// Index of the first motion for which X, Y, Z have been programmed; before it the axes are at the machine's
    /// position at the start of the program, whatever `start` says.
    std::array<std::int64_t, 3> programmed_from{};
    std::vector<Call> calls;    ///< each after its caller; the same line with the same caller is one call
    std::vector<Arc> arcs;      ///< sorted by motion
    std::vector<Curve> curves;  ///< sorted by motion
    Xyz start{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
              std::numeric_limits<double>::quiet_NaN()};  ///< before the first motion; NaN: unknown

    [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(kind.size()); }
    /// The beginning of motion i: the end of the motion before.
    [[nodiscard]] const Xyz& begin_of(std::int64_t i) const {
        return i == 0 ? start : end[static_cast<std::size_t>(i - 1)];
    }
    /// The frame of motion i. O(1).
    [[nodiscard]] const WorkFrame& frame_of(std::int64_t i) const {
        return frames[frame.empty() ? 0 : frame[static_cast<std::size_t>(i)]];
    }
    /// The arc of motion i; nullptr for anything but cw and ccw. O(log arcs).
    [[nodiscard]] const Arc* arc_of(std::int64_t i) const;
    /// The curve of motion i; nullptr for anything but a spline, and for a spline that is a chord of an arc. O(log curves).
    [[nodiscard]] const Curve* curve_of(std::int64_t i) const;

    /// Removes the first motions; calls stay. O(remaining motions).
    void drop_front(std::int64_t count);
    /// Keeps the first motions only; all calls and frames stay. O(1), and O(log arcs).
    void truncate(std::int64_t count);
};

}  // namespace clsurf
