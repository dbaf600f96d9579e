#include "simulation/plan/refiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/plan/held_place.h"

namespace clsurf {
namespace {

// 350 instead of 250 cells, 14 instead of 10 of them over a ramp, and cells that end where bends begin brought the published
// curves within 1 % of the optimum (docs/experiments/simulation.md#run-time).
constexpr std::size_t most_cells_of_window = 350;
constexpr double run_share = 0.85;          ///< share of a window that is run before it is planned again
constexpr double rest_share = 0.35;         ///< share of the jerk phase next to a rest, where v² is not a quadratic
constexpr double growth = 0.15;             ///< longest cell, as a share of the time from or to a rest
constexpr double cells_a_ramp = 14;         ///< cells in the shortest time to the greatest acceleration
constexpr double most_change = 0.05;        ///< share by which the jerk may change the speed in a cell
constexpr double most_turn_of_cell = 0.05;  ///< [rad] of the path in a cell
constexpr double approach = 0.5;            ///< share of the distance over which the pace would fall to 0
constexpr double turn_share = 0.7;          ///< share of that turn after which a cell ends
// Short spans share a cell until it has the least duration; samples keep the limits of each span. This duration is also a
// part of the ramp time, since the speed hardly changes in less. Where a straight section meets a curved one, limits change:
// a cell of less than this duration ends there.
constexpr double least_cells_a_ramp = 28, least_periods = 0.4, most_periods = 3, least_at_bend = 0.3;
// The places at which a part of a span is checked, by its duration in periods: two, three, five, nine.
constexpr double briefest = 0.5, brief = 1, middling = 2.5;
constexpr double slight = 0.01;  ///< [rad] a small turn
// A window that cannot be solved is tried with an end in its last part, at most this many times.
constexpr double shortening = 0.3;
// See docs/simulate.md#4-look-ahead, point 3.
constexpr int most_shortenings = 2;
constexpr std::size_t fewest_cells = 8;
constexpr double long_cruise = 20, cruise_left = 4;  ///< cells

LimitingFactor limiting_of(Row row, LimitingFactor at_cap, LimitingFactor in_bend, bool rounded) {
    switch (row) {
        case Row::cap: return at_cap;
        case Row::bend: return in_bend;
        case Row::tangential_acceleration:
        case Row::axis_acceleration: return LimitingFactor::axis_acceleration;
        // A wider tolerance rounds a corner more gently; the bend of an arc or a spline is part of the program.
        case Row::bend_jerk: return rounded ? LimitingFactor::corner_tolerance : LimitingFactor::jerk;
        default: return LimitingFactor::jerk;
    }
}

/// Change of direction over the programmed arc length [rad/mm].
double turn_rate(const PathDerivatives& d) {
    const double square = d.first.squaredNorm();
    return square > 0 ? d.first.cross(d.second).norm() / square : 0;
}

/// The approximate length from a place on a span over which the direction turns by an angle [mm]. If the path nearly
/// reverses, the pace falls towards the place where it turns fastest: no step goes beyond that place.
double length_of_turn(const Span& span, double from, double turn) {
    const PathDerivatives here = span.derivatives(from);
    const Pace pace = pace_of(here);
    double rate = std::max(turn_rate(here), 1e-9);
    rate = std::max(rate, turn_rate(span.derivatives(std::min(from + turn / rate, span.length))));
    const double length = turn / rate;
    return pace.slope < 0 ? std::min(length, approach * pace.value / -pace.slope) : length;
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

/// Whether a run has a long section at the greatest speed that all limits except those of bends permit.
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
        // A part of it next to the ramps is kept, so that other ramps than the planned ones fit.
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
    if (waiting_.size() == 1 && cells_.empty()) {  // it may be run alone
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

/// Divides a section into cells, without the parts next to a rest.
void Refiner::divide(Section& section) {
    const KeptRun& run = kept(section.run);
    const SCurve& profile = run.profile;
    if (run.from_rest && section.from == 0) {
        lead_ = section;
        lead_.to = std::min(rest_share * profile.durations()[0], section.to);
        section.from = lead_.to;
        steepest_lead_ =
            steepest_from_rest(profile.at(lead_.to).arc_length, run.spans.begin(), run.spans.end(), *machine_);
    }
    if (run.to_rest && section.to == profile.duration()) {
        tail_ = section;
        tail_.from = std::max(profile.duration() - rest_share * profile.durations()[6], section.from);
        section.to = tail_.from;
        steepest_tail_ = steepest_from_rest(profile.length() - profile.at(tail_.from).arc_length, run.spans.rbegin(),
                                            run.spans.rend(), *machine_);
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
        end_cell_before(span);
        const double end = k + 1 < run.spans.size() ? begin + span.length : profile.length();
        double arc_length = std::max(begin, arc_length_from);
        const double last = std::min(end, arc_length_to);
        const double last_time = last == arc_length_to ? section.to : profile.time_at(last);
        while (arc_length < last) {
            const double speed = std::max(profile.at(time).speed, 0.0);
            double step = std::clamp(std::sqrt(2 * most_change * speed / machine_->path.max_jerk),
                                     machine_->controller.period, knot_time_);
            if (!span.straight())
                step = std::min(step, length_of_turn(span, arc_length - begin, most_turn_of_cell) / speed);
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
            parts_.push_back({&span, arc_length - begin, next_arc_length - arc_length, 0});
            ++open_.parts;
            if (!span.straight()) {
                const double middle = 0.5 * (arc_length + next_arc_length) - begin;
                open_.turning += (next_arc_length - arc_length) * turn_rate(span.derivatives(middle));
            }
            open_.length += next_arc_length - arc_length;
            open_.end = {next.speed, next.acceleration};
            open_.end_run = section.run;
            open_.end_time = next_time;
            if (open_.length >= least_time_ * std::max(next.speed, end_.speed) ||
                open_.turning >= turn_share * most_turn_of_cell)
                close_cell();
            arc_length = next_arc_length;
            time = next_time;
        }
        begin = end;
    }
}

/// Ends the open cell where a straight section meets a curved one, unless it would be very short.
void Refiner::end_cell_before(const Span& span) {
    if (open_.length == 0 || parts_.back().span->straight() == span.straight()) return;
    if (open_.length >= least_at_bend * least_time_ * std::max(open_.end.speed, end_.speed)) close_cell();
}

void Refiner::close_cell() {
    if (open_.length == 0) return;
    open_.at_cap = LimitingFactor::none;
    CellLimits limits{infinite_speed, infinite_speed, infinite_speed};  // on a bent path the samples contain them
    samples_.clear();
    least_bend_speed_ = infinite_speed;
    double begin = 0;
    for (std::size_t k = parts_.size() - open_.parts; k < parts_.size(); ++k) {
        CellPart& part = parts_[k];
        add_part(part, begin, limits);
        begin += part.length;
    }
    problem_.add_cell(open_.length, SpeedProblem::value_between(open_.length, end_, open_.end), limits);
    for (const PathSample& sample : samples_) problem_.add_sample(sample);
    cells_.push_back(open_);
    end_ = open_.end;
    open_ = {};
}

/// Limits from a part of the open cell, `begin` after its start; on a bend also its samples.
void Refiner::add_part(CellPart& part, double begin, CellLimits& limits) {
    const Span& span = *part.span;
    open_.rounded = open_.rounded || span.rounded;
    const auto cap = [&](double speed, LimitingFactor why) {
        if (speed < limits.cap) limits.cap = speed, open_.at_cap = why;
    };
    cap(span.free_cap, span.free_limiting);
    if (span.straight() || span.base.jerk_share < 1) {
        limits.acceleration = std::min(limits.acceleration, span.acceleration);
        limits.jerk = std::min(limits.jerk, span.jerk);
    } else if (!span.rounded) {
        limits.acceleration = std::min(limits.acceleration, machine_->path.max_acceleration);
        limits.jerk = std::min(limits.jerk, machine_->path.max_jerk);
    }
    if (span.straight()) return;
    const double periods = part.length / (machine_->controller.period * std::max(end_.speed, open_.end.speed));
    const double turn = part.length * turn_rate(span.derivatives(part.from + 0.5 * part.length));
    part.pieces = turn >= 2 * slight                    ? 8
                  : periods < briefest && turn < slight ? 1
                  : periods < brief                     ? 2
                  : periods < middling                  ? 4
                                                        : 8;
    for (int k = 0; k <= part.pieces; ++k) {
        auto [sample, bend] = held_place(part, part.length * k / part.pieces, *machine_);
        sample.at += begin;
        if (bend.speed < least_bend_speed_) least_bend_speed_ = bend.speed, open_.in_bend = bend.why;
        samples_.push_back(sample);
    }
}

/// Places halfway between the samples of the cells at which the solution exceeds a limit.
std::vector<SpeedProblem::Between> Refiner::broken_between() const {
    std::vector<SpeedProblem::Between> broken;
    auto part = parts_.begin();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        double begin = 0;
        for (const auto end = part + static_cast<std::ptrdiff_t>(cells_[i].parts); part != end; ++part) {
            for (int k = 0; k < part->pieces; ++k) {
                PathSample sample = held_place(*part, part->length * (k + 0.5) / part->pieces, *machine_).sample;
                sample.at += begin;
                if (problem_.breaks(i, sample)) broken.push_back({i, sample});
            }
            begin += part->length;
        }
    }
    return broken;
}

/// Solves the window and runs most of it, or all.
void Refiner::solve(bool to_the_end) {
    close_cell();
    const auto run_most = [&] {
        run_cells(static_cast<std::size_t>(std::ceil(run_share * static_cast<double>(cells_.size()))), false);
    };
    if (solve_from_rests(to_the_end && ends_at_rest_)) {
        solved_ = cells_.size();
        waiting_.clear();
        run_lead();
        if (to_the_end)
            run_cells(cells_.size(), ends_at_rest_);
        else
            run_most();
        return;
    }
    if (solve_in_part()) {
        run_lead();
        solved_ = cells_.size();
        const Cell last = cells_.back();
        run_most();
        wait_from(last);
        if (to_the_end) solve(true);
        return;
    }
    steepest_lead_ = steepest_tail_ = {};
    run_lead();
    // The previous solution is continued up to the start of the plan that was not refined.
    cells_.resize(solved_);
    if (solved_ > 0) end_ = state_at(kept(waiting_.front().run).profile, waiting_.front().from);
    run_cells(solved_, false);
    for (const Section& section : waiting_) run_as_planned(section);
    waiting_.clear();
    parts_.clear();
    problem_.clear();
}

/// The planned speed at the end may be higher than the adjacent cells can reach, mostly if feeds differ from block to
/// block. An earlier end, where the plan is slow, is feasible.
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
        if (solve_from_rests(false)) return true;
    }
    return false;
}

/// Solves between the states next to rests at the greatest jerk. If that fails, between the planned states.
bool Refiner::solve_from_rests(bool to_rest) {
    const KnotState start = start_, end = end_;
    const bool leads = lead_.to > lead_.from && steepest_lead_.jerk > 0;
    const bool trails = to_rest && tail_.to > tail_.from && steepest_tail_.jerk > 0;
    for (const bool steep_end : {true, false}) {
        if (steep_end && !trails) continue;
        for (const bool steep_start : {true, false}) {
            if (steep_start && !leads) continue;
            start_ = steep_start ? KnotState{steepest_lead_.speed, steepest_lead_.acceleration} : start;
            end_ = steep_end ? KnotState{steepest_tail_.speed, -steepest_tail_.acceleration} : end;
            if (!problem_.solve(start_, end_, [this] { return broken_between(); })) continue;
            if (!steep_start) steepest_lead_ = {};
            if (to_rest && !steep_end) steepest_tail_ = {};
            return true;
        }
    }
    start_ = start;
    end_ = end;
    return false;
}

/// The section from rest to the first cell.
void Refiner::run_lead() {
    if (!(lead_.to > lead_.from)) return;
    if (steepest_lead_.jerk > 0) {
        const KeptRun& run = kept(lead_.run);
        const double time = steepest_lead_.time;
        const SCurve profile(0, steepest_lead_.jerk, {time, 0, time, 0, 0, 0, 0});
        sink_->run(ProfileSegment{&profile, 0, time, run.spans, false, run.derated});
    } else {
        run_as_planned(lead_);
    }
    lead_ = {};
    steepest_lead_ = {};
}

/// The section from the last cell to rest.
void Refiner::run_tail() {
    if (!(tail_.to > tail_.from)) return;
    if (steepest_tail_.jerk > 0) {
        const KeptRun& run = kept(tail_.run);
        const double time = steepest_tail_.time, jerk = steepest_tail_.jerk;
        const SCurve profile(jerk * time * time, jerk, {0, 0, 0, 0, time, 0, time});
        sink_->run(ProfileSegment{&profile, time, 2 * time, run.spans, true, run.derated,
                                  run.profile.length() - profile.length()});
    } else {
        run_as_planned(tail_);
    }
    tail_ = {};
    steepest_tail_ = {};
}

/// Divides the waiting sections after a cell into cells again.
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
    // Braking to the end of the known path.
    std::size_t braking = count;
    while (to_rest && braking > 0 && motions[braking - 1].acceleration < 0) --braking;
    std::size_t part = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const LimitingFactor limiting =
            i >= braking ? LimitingFactor::lookahead_end
                         : limiting_of(problem_.limiting(i), cells_[i].at_cap, cells_[i].in_bend, cells_[i].rounded);
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
    if (ends_at_rest_) run_tail();
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
