#include "simulation/plan/lookahead.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double holds = 1 + 1e-9;          ///< share of a limit that counts as kept
constexpr double braking_tolerance = 1e-9;  ///< share of a start speed, for rounding in reach()

/// The greatest speed and acceleration of a profile between two times.
struct Extremes {
    double speed = 0, acceleration = 0;
    bool ramping = false;
};

Extremes extremes(const SCurve& profile, double from, const MotionState& at_from, double to, const MotionState& at_to) {
    Extremes e;
    const double cruise_begins = profile.end_of(2);
    const double cruise_ends = profile.end_of(3);
    e.speed = from <= cruise_ends && to >= cruise_begins ? profile.peak_speed() : std::max(at_from.speed, at_to.speed);
    e.ramping = from < cruise_begins || to > cruise_ends;
    e.acceleration = std::max(std::abs(at_from.acceleration), std::abs(at_to.acceleration));
    for (const int peak : {1, 5}) {  // the acceleration is greatest at the end of its jerk phase
        const double begins = profile.end_of(peak - 1);
        if (from <= profile.end_of(peak) && to >= begins)
            e.acceleration = std::max(e.acceleration, std::abs(profile.start_of(peak).acceleration));
    }
    return e;
}

}  // namespace

bool scan_speeds(std::span<const ScanSegment> segments, std::span<double> speeds) {
    const double present = speeds.front();
    for (std::size_t i = segments.size(); i-- > 0;) {
        const ScanSegment& s = segments[i];
        if (speeds[i] > speeds[i + 1])
            speeds[i] = std::min(speeds[i], reach(speeds[i + 1], s.length, s.acceleration, s.jerk));
    }
    if (speeds.front() < present * (1 - braking_tolerance)) return false;
    speeds.front() = present;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const ScanSegment& s = segments[i];
        if (speeds[i + 1] > speeds[i])
            speeds[i + 1] = std::min(speeds[i + 1], reach(speeds[i], s.length, s.acceleration, s.jerk));
    }
    return true;
}

const Derating& WindowPlanner::derated(std::span<const Span> spans, std::size_t span) {
    Derating& derating = derated_[span];
    if (derating.cap < 0) derating = derate(spans[span], *machine_, derating_);
    return derating;
}

void WindowPlanner::set_limits(SpeedRun& run, std::span<const Span> spans) {
    run.length = 0;
    run.speed = 0;
    run.acceleration = run.jerk = std::numeric_limits<double>::infinity();
    for (std::size_t i = run.first; i < run.last; ++i) {
        const Span& s = spans[i];
        const Derating limits = run.derated ? derated(spans, i) : Derating{s.cap, s.acceleration, s.jerk};
        run.length += s.length;
        run.speed = std::max(run.speed, limits.cap);
        run.acceleration = std::min(run.acceleration, limits.acceleration);
        run.jerk = std::min(run.jerk, limits.jerk);
    }
    run.checked = false;
}

/// The greatest share of a limit of an axis, or of the path's acceleration and jerk, at a speed and an acceleration on a
/// span.
double WindowPlanner::part_of_limits(const Span& span, double speed, double acceleration, double jerk) const {
    double worst = 0;
    if (span.rounded) {
        const PathLimits& path = machine_->path;
        worst = std::max((span.greatest_first * acceleration + span.pace_slope * speed * speed) / path.max_acceleration,
                         (span.greatest_first * jerk + 3 * span.pace_slope * speed * acceleration +
                          span.pace_curve * speed * speed * speed) /
                             path.max_jerk);
    }
    for (int k = 0; k < 3; ++k) {
        const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(k)];
        worst =
            std::max(worst, (span.first[k] * acceleration + span.second[k] * speed * speed) / axis.max_acceleration);
        if (axis.max_jerk <= 0) continue;
        worst = std::max(worst, (span.first[k] * jerk + 3 * span.second[k] * speed * acceleration +
                                 span.third[k] * speed * speed * speed) /
                                    axis.max_jerk);
    }
    return worst;
}

WindowPlanner::Verdict WindowPlanner::judge(const SpeedRun& run, std::span<const Span> spans) const {
    Verdict verdict;
    const SCurve& profile = run.profile;
    const double steepest =
        std::max(std::abs(profile.start_of(1).acceleration), std::abs(profile.start_of(5).acceleration));
    double end = 0;
    double from = 0;
    MotionState at_from = profile.at(0);
    bool known = true;  // from and at_from are those at the start of the span
    for (std::size_t i = run.first; i < run.last; ++i) {
        const Span& s = spans[i];
        const double begin = end;
        end += s.length;
        const double at_peak = profile.peak_speed() / s.cap;
        if (begin >= profile.start_of(3).arc_length && end <= profile.start_of(4).arc_length) {
            if (at_peak > verdict.worst) verdict = {at_peak, true, i};
            known = false;
            continue;
        }
        // A span that satisfies the limits at every state of the run cannot be the worst span of an infeasible run.
        if (at_peak <= 1 && part_of_limits(s, profile.peak_speed(), steepest, profile.jerk()) <= 1) {
            known = false;
            continue;
        }
        if (!known) {
            from = profile.time_at(begin);
            at_from = profile.at(from);
        }
        const double to = i + 1 == run.last ? profile.duration() : profile.time_at(end);
        const MotionState at_to = profile.at(to);
        const Extremes e = extremes(profile, from, at_from, to, at_to);
        const double of_cap = e.speed / s.cap;
        const double of_limits = e.ramping ? part_of_limits(s, e.speed, e.acceleration, profile.jerk()) : 0.0;
        const double worst = std::max(of_cap, of_limits);
        if (worst > verdict.worst) verdict = {worst, of_limits <= of_cap, i};
        from = to;
        at_from = at_to;
        known = true;
    }
    return verdict;
}

/// The worst span becomes a separate run.
void WindowPlanner::divide(const SpeedRun& run, const Verdict& verdict, std::vector<SpeedRun>& into) const {
    const auto part = [&](std::size_t first, std::size_t last) {
        if (first >= last) return;
        SpeedRun r;
        r.first = first;
        r.last = last;
        into.push_back(r);
    };
    part(run.first, verdict.span);
    part(verdict.span, verdict.span + 1);
    part(verdict.span + 1, run.last);
}

bool WindowPlanner::plan(std::span<const Span> spans, double start_speed, std::span<const std::size_t> nodes) {
    if (refined_ && plan_with(deratings - 1, spans, start_speed, nodes)) {
        best_.swap(runs_);
        return true;
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t derating = 0; derating < deratings; ++derating) {
        if (!plan_with(derating, spans, start_speed, nodes)) continue;
        double time = 0;
        bool bent = false;
        for (const SpeedRun& run : runs_) {
            time += run.profile.duration();
            bent = bent || run.derated;
        }
        if (time < shortest) {
            shortest = time;
            best_.swap(runs_);
        }
        if (!bent) break;  // the other deratings would give the same
    }
    return std::isfinite(shortest);
}

void WindowPlanner::cut(std::span<const Span> spans, std::span<const std::size_t> nodes) {
    runs_.clear();
    std::size_t begin = 0;
    for (std::size_t n = 0; n <= nodes.size(); ++n) {
        const std::size_t last = n < nodes.size() ? nodes[n] : spans.size();
        while (begin < last) {
            // A corner that is not rounded is also a node. So is the end of a section next to an arc's step: its limits
            // would slow the rest.
            const auto joins = [&](std::size_t span) {
                return spans[span].begin_cap >= std::min(spans[span - 1].cap, spans[span].cap) &&
                       spans[span].base.jerk_share == spans[span - 1].base.jerk_share;
            };
            std::size_t end = begin + 1;
            while (end < last && joins(end)) ++end;
            SpeedRun run;
            run.first = begin;
            run.last = end;
            set_limits(run, spans);
            runs_.push_back(run);
            begin = end;
        }
    }
}

bool WindowPlanner::plan_with(std::size_t derating, std::span<const Span> spans, double start_speed,
                              std::span<const std::size_t> nodes) {
    derating_ = derating;
    derated_.assign(spans.size(), Derating{-1, 0, 0});
    cut(spans, nodes);
    const auto end_cap = [&](const SpeedRun& run, std::size_t span) {
        return run.derated ? derated(spans, span).cap : spans[span].cap;
    };
    while (true) {
        segments_.clear();
        speeds_.clear();
        for (const SpeedRun& run : runs_) {
            segments_.push_back({run.length, run.acceleration, run.jerk});
            const double before = speeds_.empty() ? start_speed
                                                  : std::min({end_cap(runs_[speeds_.size() - 1], run.first - 1),
                                                              end_cap(run, run.first), spans[run.first].begin_cap});
            speeds_.push_back(before);
        }
        speeds_.push_back(0);
        if (!scan_speeds(segments_, speeds_)) return false;
        bool changed = false;
        next_.clear();
        for (std::size_t r = 0; r < runs_.size(); ++r) {
            SpeedRun& run = runs_[r];
            if (!run.checked || run.start_speed != speeds_[r] || run.end_speed != speeds_[r + 1]) {
                run.start_speed = speeds_[r];
                run.end_speed = speeds_[r + 1];
                // A start speed that was planned with other limits may exceed these by rounding.
                run.speed = std::max({run.speed, run.start_speed, run.end_speed});
                run.profile = plan_scurve(run.length, run.start_speed, run.end_speed,
                                          {run.speed, run.acceleration, run.acceleration, run.jerk})
                                  .profile;
                if (!(run.profile.length() > 0)) return false;
                const Verdict verdict = judge(run, spans);
                run.checked = verdict.worst <= holds;
                if (!run.checked) {
                    changed = true;
                    if (run.last - run.first > 1 && (verdict.at_cap || run.derated)) {
                        const std::size_t before = next_.size();
                        divide(run, verdict, next_);
                        for (std::size_t k = before; k < next_.size(); ++k) set_limits(next_[k], spans);
                        continue;
                    }
                    if (run.derated) return false;  // the start speed exceeds the limit of this span while braking
                    run.derated = true;
                    set_limits(run, spans);
                }
            }
            next_.push_back(run);
        }
        runs_.swap(next_);
        if (!changed) return true;
    }
}

}  // namespace clsurf
