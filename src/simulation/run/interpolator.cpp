#include "simulation/run/interpolator.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double same_instant = 1e-6;  ///< share of a period: a stop less than this after a sample coincides with it

LimitingFactor limiting_of(const ProfileSegment& section, const Span& span, int phase) {
    if (phase == 3) return span.limiting;
    if (section.to_rest && phase > 3) return LimitingFactor::lookahead_end;
    return (phase == 1 || phase == 5) && !section.derated ? LimitingFactor::axis_acceleration : LimitingFactor::jerk;
}

}  // namespace

void Interpolator::run(const ProfileSegment& section) {
    const SCurve& profile = *section.profile;
    const double begin = time_ - section.from;  // time at which the whole profile would have begun
    const double end = begin + section.to;
    std::size_t at = 0;
    double before = 0;
    int phase = 0;
    for (double t = next_sample(); t < end; t = next_sample()) {
        const double on_profile = t - begin;
        while (phase < 6 && on_profile >= profile.end_of(phase)) ++phase;
        const MotionState state = profile.in_phase(phase, on_profile);
        const double arc_length = section.before + state.arc_length;
        while (at + 1 < section.spans.size() && arc_length - before > section.spans[at].length)
            before += section.spans[at++].length;
        const Span& span = section.spans[at];
        const double tau = std::clamp(arc_length - before, 0.0, span.length);
        double deviation = 0;
        double pace = 1;
        const Vec3 position = span.at(tau, deviation, pace);
        recorder_->add(position, state.speed * pace, span.base.line, limiting_of(section, span, phase), deviation);
    }
    time_ = end;
    line_ = section.spans.back().base.line;
}

void Interpolator::run(const CellMotion& motion, std::span<const CellPart> parts, LimitingFactor limiting) {
    const double begin = time_;
    const double end = begin + motion.duration();
    std::size_t at = 0;
    double before = 0;
    for (double t = next_sample(); t < end; t = next_sample()) {
        double speed = 0;
        const double arc_length = motion.arc_length_at(t - begin, speed);
        while (at + 1 < parts.size() && arc_length - before > parts[at].length) before += parts[at++].length;
        const CellPart& part = parts[at];
        const double tau = part.from + std::clamp(arc_length - before, 0.0, part.length);
        double deviation = 0;
        double pace = 1;
        const Vec3 position = part.span->at(tau, deviation, pace);
        recorder_->add(position, speed * pace, part.span->base.line, limiting, deviation);
    }
    time_ = end;
    line_ = parts.back().span->base.line;
}

void Interpolator::rest(const Vec3& position, double wait, LineNumber line) {
    const auto stop = static_cast<PointIndex>(std::ceil(time_ / period_ - same_instant));
    const auto waiting = static_cast<PointIndex>(std::ceil(wait / period_ - same_instant));
    const PointIndex last = stop + std::max<PointIndex>(0, waiting);
    while (recorder_->points() < last) recorder_->add(position, 0, line > 0 ? line : line_, LimitingFactor::none, 0);
    time_ = static_cast<double>(last) * period_;
}

}  // namespace clsurf
