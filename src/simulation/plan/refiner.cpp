#include "simulation/plan/refiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/path/junction.h"

namespace clsurf {
namespace {

constexpr std::size_t most_cells_of_window = 250;
constexpr double run_share = 0.85;   ///< of a window, before it is planned again
constexpr double rest_share = 0.25;  ///< of the jerk phase next to a rest: run as planned, as v² is no quadratic there
constexpr double growth = 0.15;      ///< of the time from or to a rest: longest cell
constexpr double cells_a_ramp = 5;   ///< over the time in which the jerk reaches the greatest acceleration
constexpr double most_change = 0.05;  ///< of the speed in a cell, by the jerk
// Spans share a cell until it lasts as long as that, and their samples hold the limits of each: a part of the
// same time, as in less of it a speed hardly changes.
constexpr double least_cells_a_ramp = 13, least_periods = 0.4, most_periods = 3;
// The places where a part of a span is held, by the periods that it lasts: two, three, five, nine.
constexpr double briefest = 0.5, brief = 1, middling = 2.5;
// A window that cannot be solved is tried with an end in its last part, so many times.
constexpr double shortening = 0.3;
constexpr int most_shortenings = 2;
constexpr std::size_t fewest_cells = 8;
constexpr double long_cruise = 20, cruise_left = 4;  ///< cells

LimitingFactor limiting_of(Row row, LimitingFactor at_cap) {
    switch (row) {
        case Row::cap: return at_cap;
        case Row::tangential_acceleration:
        case Row::axis_acceleration: return LimitingFactor::axis_acceleration;
        case Row::corner_jerk: return LimitingFactor::corner_tolerance;
        default: return LimitingFactor::jerk;
    }
}

KnotState state_at(const SCurve& profile, double time) {
    const MotionState state = profile.at(time);
    return {state.speed, state.acceleration};
}

}  // namespace

Refiner::Refiner(const Machine& machine, MotionSink& sink, std::int64_t blocks)
    : machine_(&machine), sink_(&sink), blocks_(blocks), problem_(linear_limits(machine)) {
    const double period = machine.controller.period;
    const double ramp = machine.path.max_acceleration / machine.path.max_jerk;
    knot_time_ = std::clamp(ramp / cells_a_ramp, 2 * period, 10 * period);
    least_time_ = std::clamp(ramp / least_cells_a_ramp, least_periods * period, most_periods * period);
    problem_.clear();
}

/// A long way at a speed that no limit but those of bends is above.
bool Refiner::cruises_at_the_cap(const KeptRun& run) const {
    const SCurve& profile = run.profile;
    if (profile.durations()[3] < long_cruise * knot_time_) return false;
    double begin = 0;
    for (const Span& span : run.spans) {
        const bool cruised =
            begin < profile.start_of(4).arc_length && begin + span.length > profile.start_of(3).arc_length;
        if (cruised && span.free_cap > profile.peak_speed() * (1 + 1e-9)) return false;
        begin += span.length;
    }
    return true;
}

void Refiner::push(const SpeedRun& run, std::span<const Span> spans) {
    runs_.push_back(
        {run.profile, {spans.begin(), spans.end()}, run.derated, true, run.start_speed == 0, run.end_speed == 0});
    KeptRun& kept_run = runs_.back();
    for (const Span& span : spans) kept_run.plain = kept_run.plain && span.straight();
    const std::int64_t number = first_run_ + static_cast<std::int64_t>(runs_.size()) - 1;
    const SCurve& profile = kept_run.profile;
    if (blocks_ == 0) {
        run_as_planned({number, 0, profile.end_of(6)});
    } else if (cruises_at_the_cap(kept_run)) {
        // Next to the ramps some of it is left, so that other ramps than the planned ones fit.
        const double begins = profile.end_of(2) + cruise_left * knot_time_;
        const double ends = profile.end_of(3) - cruise_left * knot_time_;
        add({number, 0, begins});
        close();
        run_as_planned({number, begins, ends});
        add({number, ends, profile.end_of(6)});
    } else {
        add({number, 0, profile.end_of(6)});
    }
    if (kept_run.to_rest) close();
    forget_runs();
}

void Refiner::run_as_planned(const Section& section) {
    const KeptRun& run = kept(section.run);
    sink_->run(ProfileSegment{&run.profile, section.from, section.to, run.spans, run.to_rest, run.derated});
}

void Refiner::add(const Section& section) {
    if (!(section.to > section.from)) return;
    waiting_.push_back(section);
    ends_at_rest_ = kept(section.run).to_rest && section.to == kept(section.run).profile.duration();
    if (waiting_.size() == 1 && cells_.empty()) {  // it may stand alone
        divided_ = false;
        return;
    }
    if (!divided_ && waiting_.size() == 2 && cells_.empty()) divide(waiting_.front());
    divided_ = true;
    divide(waiting_.back());
    const bool full = cells_.size() >= most_cells_of_window ||
                      (!cells_.empty() && kept(section.run).spans.back().base.block - cells_.front().block >= blocks_);
    if (full && !ends_at_rest_) solve(false);
}

/// Into cells; what lies next to a rest is run as planned.
void Refiner::divide(Section& section) {
    const KeptRun& run = kept(section.run);
    const SCurve& profile = run.profile;
    if (run.from_rest && section.from == 0) {
        Section first = section;
        first.to = std::min(rest_share * profile.durations()[0], section.to);
        run_as_planned(first);
        section.from = first.to;
    }
    if (run.to_rest && section.to == profile.duration()) {
        tail_ = section;
        tail_.from = std::max(profile.duration() - rest_share * profile.durations()[6], section.from);
        section.to = tail_.from;
    }
    if (cells_.empty() && open_.length == 0) start_ = end_ = state_at(profile, section.from);
    add_cells(section);
}

void Refiner::add_cells(const Section& section) {
    const KeptRun& run = kept(section.run);
    const SCurve& profile = run.profile;
    const double arc_length_from = profile.at(section.from).arc_length;
    const double arc_length_to = profile.at(section.to).arc_length;
    double begin = 0;
    double time = section.from;
    for (std::size_t k = 0; k < run.spans.size() && begin < arc_length_to; ++k) {
        const Span& span = run.spans[k];
        const double end = k + 1 < run.spans.size() ? begin + span.length : profile.length();
        double arc_length = std::max(begin, arc_length_from);
        const double last = std::min(end, arc_length_to);
        const double last_time = last == arc_length_to ? section.to : profile.time_at(last);
        while (arc_length < last) {
            const double speed = std::max(profile.at(time).speed, 0.0);
            double step = std::clamp(std::sqrt(2 * most_change * speed / machine_->path.max_jerk),
                                     machine_->controller.period, knot_time_);
            if (run.from_rest) step = std::min(step, growth * time);
            if (run.to_rest) step = std::min(step, growth * (profile.duration() - time));
            const bool ends = last_time - time < 1.5 * step;
            const double next_time = ends ? last_time : time + step;
            const MotionState next = profile.at(next_time);
            const double next_arc_length = ends ? last : std::min(next.arc_length, last);
            if (open_.length == 0) {
                open_.parts = 0;
                open_.run = section.run;
                open_.block = span.base.block;
            }
            parts_.push_back({&span, arc_length - begin, next_arc_length - arc_length});
            ++open_.parts;
            open_.length += next_arc_length - arc_length;
            open_.end = {next.speed, next.acceleration};
            open_.end_run = section.run;
            open_.end_time = next_time;
            if (open_.length >= least_time_ * std::max(next.speed, end_.speed)) close_cell();
            arc_length = next_arc_length;
            time = next_time;
        }
        begin = end;
    }
}

void Refiner::close_cell() {
    if (open_.length == 0) return;
    open_.at_cap = LimitingFactor::none;
    CellLimits limits{std::numeric_limits<double>::infinity(), machine_->path.max_acceleration,
                      machine_->path.max_jerk};
    samples_.clear();
    double begin = 0;
    for (std::size_t k = parts_.size() - open_.parts; k < parts_.size(); ++k) {
        const CellPart& part = parts_[k];
        add_part(part, begin, limits);
        begin += part.length;
    }
    problem_.add_cell(open_.length, SpeedProblem::value_between(open_.length, end_, open_.end), limits);
    for (const PathSample& sample : samples_) problem_.add_sample(sample);
    cells_.push_back(open_);
    end_ = open_.end;
    open_ = {};
}

/// What a part of the open cell, `begin` after its begin, leaves of the limits; where it is bent, its samples.
void Refiner::add_part(const CellPart& part, double begin, CellLimits& limits) {
    const Span& span = *part.span;
    const auto cap = [&](double speed, LimitingFactor why) {
        if (speed < limits.cap) limits.cap = speed, open_.at_cap = why;
    };
    cap(span.free_cap, span.free_limiting);
    if (span.straight()) {
        limits.acceleration = std::min(limits.acceleration, span.acceleration);
        limits.jerk = std::min(limits.jerk, span.jerk);
        return;
    }
    const double periods = part.length / (machine_->controller.period * std::max(end_.speed, open_.end.speed));
    const int pieces = periods < briefest ? 1 : periods < brief ? 2 : periods < middling ? 4 : 8;
    PathSample sample;
    double curvature = 0;
    for (int k = 0; k <= pieces; ++k) {
        const double arc_length = part.length * k / pieces;
        const PathDerivatives d = span.derivatives(part.from + arc_length);
        sample.at = begin + arc_length;
        sample.slope = d.first;
        sample.bend = d.second;
        sample.twist = d.third;
        sample.pace = pace_of(d);
        curvature = std::max(curvature, d.second.squaredNorm());
        samples_.push_back(sample);
    }
    if (curvature > 0) {
        const double radius = 1 / std::sqrt(curvature);
        cap(arc_speed(radius, machine_->path.max_normal_acceleration), LimitingFactor::axis_acceleration);
        cap(chord_speed(radius, machine_->controller.chord_tolerance, machine_->controller.period),
            LimitingFactor::chord_error);
    }
}

/// Makes the window fast and runs most of it, or all.
void Refiner::solve(bool to_the_end) {
    close_cell();
    const auto run_most = [&] {
        run_cells(static_cast<std::size_t>(std::ceil(run_share * static_cast<double>(cells_.size()))), false);
    };
    if (problem_.solve(start_, end_)) {
        solved_ = cells_.size();
        waiting_.clear();
        if (to_the_end)
            run_cells(cells_.size(), ends_at_rest_);
        else
            run_most();
        return;
    }
    if (solve_in_part()) {
        solved_ = cells_.size();
        const Cell last = cells_.back();
        run_most();
        wait_from(last);
        if (to_the_end) solve(true);
        return;
    }
    // What was found before goes on to where the plan begins that was not refined.
    cells_.resize(solved_);
    if (solved_ > 0) end_ = state_at(kept(waiting_.front().run).profile, waiting_.front().from);
    run_cells(solved_, false);
    for (const Section& section : waiting_) run_as_planned(section);
    waiting_.clear();
    parts_.clear();
    problem_.clear();
}

/// The plan's speed at the end may be more than the cells next to it can come to, most often where feeds differ from block to block. To
/// an earlier place where the plan is slow there is a way.
bool Refiner::solve_in_part() {
    for (int k = 0; k < most_shortenings; ++k) {
        const std::size_t fewest =
            std::max(solved_ + fewest_cells,
                     static_cast<std::size_t>(std::ceil((1 - shortening) * static_cast<double>(cells_.size()))));
        if (fewest >= cells_.size()) return false;
        std::size_t count = fewest;
        for (std::size_t i = fewest; i < cells_.size(); ++i) {
            if (cells_[i - 1].end.speed < cells_[count - 1].end.speed) count = i;
        }
        std::size_t parts = 0;
        for (std::size_t i = 0; i < count; ++i) parts += cells_[i].parts;
        cells_.resize(count);
        parts_.resize(parts);
        problem_.drop_back(count);
        end_ = cells_.back().end;
        if (problem_.solve(start_, end_)) return true;
    }
    return false;
}

/// The waiting sections behind a cell are divided anew.
void Refiner::wait_from(const Cell& cell) {
    while (waiting_.front().run != cell.end_run) waiting_.erase(waiting_.begin());
    waiting_.front().from = cell.end_time;
    for (const Section& section : waiting_) add_cells(section);
}

void Refiner::run_cells(std::size_t count, bool to_rest) {
    const std::size_t n = cells_.size();
    std::vector<CellMotion> motions(count);
    KnotState at = start_;
    for (std::size_t i = 0; i < count; ++i) {
        KnotState next = end_;
        const double h = cells_[i].length;
        if (i + 1 < n) {
            const double after = cells_[i + 1].length;
            const double c0 = problem_.value(i), c1 = problem_.value(i + 1);
            next = {std::sqrt((after * c0 + h * c1) / (h + after)), (c1 - c0) / (h + after)};
        }
        motions[i] = {h, at.speed, at.acceleration, (next.acceleration - at.acceleration) / h};
        at = next;
    }
    start_ = at;
    // Braking to the end of what is known.
    std::size_t braking = count;
    while (to_rest && braking > 0 && motions[braking - 1].acceleration < 0) --braking;
    std::size_t part = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const LimitingFactor limiting =
            i >= braking ? LimitingFactor::lookahead_end : limiting_of(problem_.limiting(i), cells_[i].at_cap);
        sink_->run(motions[i], std::span(parts_).subspan(part, cells_[i].parts), limiting);
        part += cells_[i].parts;
    }
    cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count));
    parts_.erase(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(part));
    problem_.drop_front(count);
    solved_ -= count;
}

void Refiner::close() {
    const bool alone = !divided_ && waiting_.size() == 1 && cells_.empty();
    if (alone && kept(waiting_.front().run).plain && !kept(waiting_.front().run).derated) {
        run_as_planned(waiting_.front());
        waiting_.clear();
        return;
    }
    if (alone) divide(waiting_.front());
    if (!waiting_.empty())
        solve(true);
    else
        run_cells(cells_.size(), ends_at_rest_);
    if (ends_at_rest_ && tail_.to > tail_.from) run_as_planned(tail_);
    tail_ = {};
    ends_at_rest_ = false;
    divided_ = false;
    problem_.clear();
    parts_.clear();
    cells_.clear();
    solved_ = 0;
    open_ = {};
}

void Refiner::forget_runs() {
    std::int64_t needed = first_run_ + static_cast<std::int64_t>(runs_.size());
    if (!waiting_.empty()) needed = std::min(needed, waiting_.front().run);
    if (!cells_.empty()) needed = std::min(needed, cells_.front().run);
    if (open_.length > 0) needed = std::min(needed, open_.run);
    for (; first_run_ < needed; ++first_run_) runs_.pop_front();
}

}  // namespace clsurf
