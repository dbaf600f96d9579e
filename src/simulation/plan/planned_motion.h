#pragma once
// The elements of a plan: jerk-limited profiles over spans, and cells over which v² is quadratic. Planners pass them to a
// MotionSink in the order of the path.

#include <span>

#include "simulation/path/path_stream.h"
#include "simulation/plan/scurve.h"

namespace clsurf {

/// A section of a jerk-limited profile over consecutive spans.
struct ProfileSegment {
    const SCurve* profile = nullptr;
    double from = 0, to = 0;      ///< time on the profile [s]
    std::span<const Span> spans;  ///< the first is the span on which the profile begins
    bool to_rest = false;         ///< the profile brakes to a stop
    bool derated = false;         ///< ramps are kept low because of the jerk that they cause on bends
    double before = 0;            ///< arc length on the spans before the profile begins [mm]
};

/// v² over arc length u is a quadratic: v² = speed² + 2 acceleration u + curve u².
struct CellMotion {
    double length = 0, speed = 0, acceleration = 0, curve = 0;
    [[nodiscard]] double duration() const;
    /// Arc length after a time [mm]; `v`: output, the speed there.
    [[nodiscard]] double arc_length_at(double time, double& v) const;
};

/// A part of a span that a cell covers.
struct CellPart {
    const Span* span = nullptr;
    double from = 0, length = 0;  ///< on the span [mm]
    int pieces = 0;               ///< number of equal pieces with checked ends; 0: the part is straight
};

/// Receives a plan, element by element.
class MotionSink {
public:
    MotionSink() = default;
    MotionSink(const MotionSink&) = delete;
    MotionSink& operator=(const MotionSink&) = delete;
    virtual ~MotionSink() = default;

    virtual void run(const ProfileSegment& section) = 0;
    virtual void run(const CellMotion& motion, std::span<const CellPart> parts, LimitingFactor limiting) = 0;
};

}  // namespace clsurf
