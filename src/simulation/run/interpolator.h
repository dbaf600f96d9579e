#pragma once
// Interpolator: samples planned speeds with one clock for the whole program. Sample k is the position at time k T; the rest
// of a period at the end of a section continues in the next section.

#include <span>

#include "simulation/plan/planned_motion.h"
#include "simulation/run/recorder.h"

namespace clsurf {

class Interpolator final : public MotionSink {
public:
    Interpolator(double period, Recorder& recorder) : recorder_(&recorder), period_(period) {}

    /// Adds all samples within a section, including its start, without its end.
    void run(const ProfileSegment& section) override;
    void run(const CellMotion& motion, std::span<const CellPart> parts, LimitingFactor limiting) override;
    /// Adds samples at rest until `wait` seconds after the next sample.
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
