#pragma once
// What a plan consists of: profiles with limited jerk over spans, and cells over which v² is quadratic. Planners pass them
// to a MotionSink in the order of the path.

#include <span>

#include "simulation/path/path_stream.h"
#include "simulation/plan/scurve.h"

namespace clsurf {

/// A part of a jerk-limited profile over spans that follow each other.
struct ProfileSegment {
    const SCurve* profile = nullptr;
    double from = 0, to = 0;      ///< time on the profile [s]
    std::span<const Span> spans;  ///< from that on which the profile begins
    bool to_rest = false;         ///< the profile brakes to a stop
    bool derated = false;         ///< ramps are kept low for the jerk that they cost in bends
    double before = 0;            ///< arc length on the spans before the profile begins [mm]
};

/// Constant change of v² over arc length u: v² = speed² + 2 acceleration u + curve u².
struct CellMotion {
    double length = 0, speed = 0, acceleration = 0, curve = 0;
    [[nodiscard]] double duration() const;
    /// Arc length after a time [mm]; `v`: the speed there.
    [[nodiscard]] double arc_length_at(double time, double& v) const;
};

/// What a cell runs over: parts of spans.
struct CellPart {
    const Span* span = nullptr;
    double from = 0, length = 0;  ///< on the span [mm]
    int pieces = 0;               ///< equal ones, at whose ends its planner holds the limits; 0: it is straight
};

/// Receives a plan, part by part.
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
