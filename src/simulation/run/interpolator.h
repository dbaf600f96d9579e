#pragma once
// Interpolator: runs planned speeds against one clock for the whole program. Sample k is the position at k T;
// the rest of a period at the end of a section continues in the next one.

#include <span>

#include "simulation/path/path_stream.h"
#include "simulation/plan/scurve.h"
#include "simulation/run/recorder.h"

namespace clsurf {

/// A part of a jerk-limited profile over spans that follow each other.
struct ProfileSegment {
    const SCurve* profile = nullptr;
    double from = 0, to = 0;      ///< time on the profile [s]
    std::span<const Span> spans;  ///< from that on which the profile begins
    bool to_rest = false;         ///< the profile brakes to a stop
    bool derated = false;         ///< ramps are kept low for the jerk that they cost in bends
};

/// Constant change of v² over the way: v² = speed² + 2 acceleration u + curve u².
struct CellMotion {
    double length = 0, speed = 0, acceleration = 0, curve = 0;
    [[nodiscard]] double duration() const;
    /// Arc length after a time [mm]; `speed` there.
    [[nodiscard]] double arc_length_at(double time, double& speed) const;
};

/// What a cell runs over: parts of spans.
struct CellPart {
    const Span* span = nullptr;
    double from = 0, length = 0;  ///< on the span [mm]
};

class Interpolator {
public:
    Interpolator(double period, Recorder& recorder) : recorder_(&recorder), period_(period) {}

    /// All samples that fall into a section, from its start on, its end not included.
    void run(const ProfileSegment& section);
    void run(const CellMotion& motion, std::span<const CellPart> parts, LimitingFactor limiting);
    /// At rest until `wait` seconds after the next sample.
    void rest(const Vec3& position, double wait, LineNumber line);
    /// Line of the last motion.
    [[nodiscard]] LineNumber line() const { return line_; }

private:
    [[nodiscard]] double next_sample() const { return static_cast<double>(recorder_->points()) * period_; }

    Recorder* recorder_;
    double period_;
    double time_ = 0;
    LineNumber line_ = 0;
};

}  // namespace clsurf
