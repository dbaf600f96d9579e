#include "simulation/plan/five_axis_speeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/not_finite.h"
#include "simulation/path/junction.h"
#include "simulation/plan/broken_places.h"
#include "simulation/plan/five_axis_limits.h"
#include "simulation/plan/rest_pieces.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {
namespace {

constexpr double first_share = 0.5;   ///< share of the limits for the first speeds
constexpr double cells_in_ramp = 10;  ///< cells in the time in which the jerk limit reaches the acceleration limit
// With cells that grow away from corners and turns, forty lines of 200 mm take 0.18 instead of 5.5 s
// (docs/experiments/simulation.md#run-time).
constexpr double cell_growth = 0.15;     ///< longest cell, as a share of the time from or to a rest or a rounding
constexpr double most_cell_turn = 0.05;  ///< [rad] turn of the angles in a cell that is longer than the shortest
constexpr double slow_approach = 0.5;    ///< longest cell before a slow place, as a share of the distance to it
constexpr std::size_t window_cells = 1500;
constexpr std::size_t least_cells = 100;                                       ///< cells of a window that is shortened
constexpr double kept_share = 0.6;                                             ///< share of a window that is run
constexpr std::array<double, 6> slower_tries{1, 0.5, 0.25, 0.1, 0.03, 0.003};  ///< shares of the first v² to try
// Without this bound, three programs with random limits had not ended after a minute.
constexpr std::size_t most_cells = 12000;  ///< cells of a window; if there are more, a shorter window is planned
constexpr double held_share = 0.7;         ///< share of the greatest v² that satisfies every limit
constexpr int most_halvings = 30;          ///< number of times that v² is halved if it exceeds a limit between samples

class FiveAxisPlanner {
public:
    FiveAxisPlanner(const FiveAxisPath& path, const Machine& machine,
                    const std::function<Place(std::size_t block)>& place_of)
        : path_(&path),
          place_of_(&place_of),
          limits_(path, machine),
          places_(limits_.at_places()),
          rests_(limits_, places_),
          problem_(limits_.of_axes(), FirstSpeeds::guess),
          ramp_(limits_.ramp()) {}

    std::vector<FiveAxisMotion> plan() {
        const double length = path_->length();
        double from = 0;
        while (from < length) from = window(from);
        return std::move(motions_);
    }

private:
    /// v² at a distance from a rest, at constant jerk.
    [[nodiscard]] static double square_at(double distance, double jerk) {
        const double time = std::cbrt(6 * distance / jerk);
        return 0.25 * jerk * jerk * time * time * time * time;
    }

    /// Plans from rest at `from` to the next rest. Returns the position of that rest.
    double window(double from) {
        state_ = {};
        at_ = from;
        while (true) {
            double end = horizon(window_cells);
            bool solved = solve(end);
            // A window must end at rest. On a bend that may be infeasible, but feasible a little before it.
            for (std::size_t cells = window_cells / 2; !solved && cells >= least_cells; cells /= 2) {
                const double earlier = horizon(cells);
                if (earlier >= end) continue;
                end = earlier;
                solved = solve(end);
            }
            if (!solved && tail_.empty()) solved = solve_held(end);
            const bool last = end >= path_->length();
            if (!solved) {
                // The motion that was planned before comes to rest.
                if (tail_.empty()) {
                    throw InputError((*place_of_)(path_->chord(path_->chord_at(at_)).block),
                                     "no speed satisfies all axis limits here");
                }
                for (const FiveAxisMotion& motion : tail_) motions_.push_back(motion);
                tail_.clear();
                return tail_end_;
            }
            run(last);
            if (last) {
                tail_.clear();
                return path_->length();
            }
        }
    }

    /// The end of a window of about `most` cells.
    [[nodiscard]] double horizon(std::size_t most) {
        double cells = 0;
        auto place = std::lower_bound(places_.begin(), places_.end(), at_,
                                      [](const LimitPlace& p, double u) { return p.u < u; });
        for (double u = at_; place != places_.end(); ++place) {
            const double in_step = (place->u - u) / std::max(1e-6, place->cap) * cells_in_ramp / ramp_;
            const double grown = std::log1p(cell_growth * in_step) / cell_growth +
                                 path_->turning(0.5 * (u + place->u)) * (place->u - u) / most_cell_turn;
            cells += std::min(in_step, grown);
            u = place->u;
            if (cells > static_cast<double>(most) && u > at_) break;
        }
        return place == places_.end() ? path_->length() : place->u;
    }

    /// First speeds at the places from at_ to `end`, with v² multiplied by `scale`.
    void scan(double end, double scale) {
        first_ = static_cast<std::size_t>(std::upper_bound(places_.begin(), places_.end(), at_,
                                                           [](double u, const LimitPlace& p) { return u < p.u; }) -
                                          places_.begin());
        last_ = first_;
        while (last_ < places_.size() && places_[last_].u < end) ++last_;
        const double jerk = scale * first_share;
        double before = state_.speed * state_.speed, u = at_;
        for (std::size_t i = first_; i < last_; ++i) {
            LimitPlace& p = places_[i];
            const double reached = state_.speed > 0 || i > first_
                                       ? before + 2 * first_share * scale * p.acceleration * (p.u - u)
                                       : infinite;
            p.square = std::min(scale * p.cap * p.cap, reached);
            if (state_.speed == 0) p.square = std::min(p.square, square_at(p.u - at_, jerk * p.jerk));
            before = p.square;
            u = p.u;
        }
        before = infinite;
        u = end;
        for (std::size_t i = last_; i-- > first_;) {
            LimitPlace& p = places_[i];
            if (before < infinite)
                p.square = std::min(p.square, before + 2 * first_share * scale * p.acceleration * (u - p.u));
            p.square = std::min(p.square, square_at(end - p.u, jerk * p.jerk));
            before = p.square;
            u = p.u;
        }
    }

    bool solve(double end) {
        for (const double scale : slower_tries) {
            scan(end, scale);
            if (!divide_window(end) || cells_.size() > most_cells) return false;
            if (find_speeds()) return true;
        }
        return false;
    }

    bool find_speeds() {
        const BrokenPlaces broken = broken_places();
        return problem_.solve(start_, stop_, [&broken] { return broken.find(); });
    }

    /// Used if no first speeds lead to a solution: starts from speeds that satisfy every limit. These exist on every path
    /// between rests: if v² is lower by one factor everywhere, accelerations are lower by that factor and jerks are lower,
    /// too. Sets `end` to the end of the window. If nothing faster is found, the window is as short as possible.
    bool solve_held(double& end) {
        for (std::size_t cells = window_cells; cells >= least_cells; cells /= 2) {
            end = horizon(cells);
            scan(end, 1);
            if (!divide_window(end)) continue;
            const bool shortest = cells / 2 < least_cells;
            if (cells_.size() > most_cells && !shortest) continue;
            if (!scale_to_limits()) continue;
            if (find_speeds() || shortest) return true;
        }
        return false;
    }

    /// Lowers all v² of the window by one factor until all limits are satisfied.
    bool scale_to_limits() {
        slow_down(held_share * problem_.holding_share(start_, stop_));
        const BrokenPlaces broken = broken_places();
        for (int k = 0; k < most_halvings; ++k) {
            if (broken.find().empty()) return true;
            slow_down(0.5);
        }
        return false;
    }

    void slow_down(double share) {
        problem_.scale(share);
        const double root = std::sqrt(share);
        for (KnotState* state : {&start_, &stop_}) *state = {root * state->speed, share * state->acceleration};
        for (FiveAxisMotion* piece : {&first_piece_, &last_piece_})
            piece->jerk *= share * root, piece->duration /= root;  // their lengths do not change
    }

    /// Makes the cells up to a rest at `end`, with first speeds, and the pieces next to the rests. False: there is no space
    /// for cells.
    bool divide_window(double end) {
        problem_.clear();
        cells_.clear();
        const double length = end - at_;
        const RestPiece last = rests_.at(end, -1, length);
        const double last_u = end - last.length();
        const KnotState stop{0.5 * last.jerk * last.time * last.time, -last.jerk * last.time};
        KnotState start = state_;
        double u = at_, start_time = 0;
        first_piece_ = {};
        if (start.speed == 0) {
            const RestPiece first = rests_.at(at_, 1, length);
            start_time = first.time;
            start = {0.5 * first.jerk * start_time * start_time, first.jerk * start_time};
            first_piece_ = {at_, start_time, {}, first.jerk, LimitingFactor::jerk};
            u += first.length();
        }
        last_piece_ = {last_u, last.time, {}, -last.jerk, LimitingFactor::lookahead_end};
        if (!(last_u > u)) return false;
        // If the window begins in motion, cells grow as after a rest, starting with the shortest cell.
        if (start_time == 0) start_time = ramp_ / cells_in_ramp / cell_growth;
        divide(u, last_u, start, stop, start_time, last.time);
        start_ = start;
        stop_ = stop;
        return true;
    }

    /// For the cells of the window.
    [[nodiscard]] BrokenPlaces broken_places() const {
        return {limits_, problem_, cells_, {places_.data() + first_, last_ - first_}};
    }

    /// First value of v² at u; `cursor`: the first place after u.
    [[nodiscard]] double square_near(double u, std::size_t cursor, double from, double from_square, double to,
                                     double to_square) const {
        double a = from, b = to, x = from_square, y = to_square;
        if (cursor > first_ && places_[cursor - 1].u > from) a = places_[cursor - 1].u, x = places_[cursor - 1].square;
        if (cursor < last_ && places_[cursor].u < to) b = places_[cursor].u, y = places_[cursor].square;
        return b > a ? x + (y - x) * std::clamp((u - a) / (b - a), 0.0, 1.0) : x;
    }

    /// The longest cell from u on at a speed: far from roundings the limits change little.
    [[nodiscard]] double longest_step(double u, double speed) const {
        const double clear = cell_growth * path_->clearance(u) / speed;
        const double turn = most_cell_turn / std::max(1e-9, path_->turning(u)) / speed;
        return std::max(ramp_ / cells_in_ramp, std::min(clear, turn));
    }

    void divide(double from, double to, const KnotState& start, const KnotState& stop, double since, double until) {
        std::size_t cursor = first_;
        const double from_square = start.speed * start.speed, to_square = stop.speed * stop.speed;
        // The step lengths are computed first, because cells become shorter before the end.
        std::vector<double> steps;
        double u = from;
        while (u < to) {
            while (cursor < last_ && places_[cursor].u <= u) ++cursor;
            const double speed = std::sqrt(std::max(1e-18, square_near(u, cursor, from, from_square, to, to_square)));
            const double remaining = to - u;
            double step = std::min(longest_step(u, speed), cell_growth * since);
            step = std::min(step, cell_growth * (until + 1.5 * remaining / std::max(speed, stop.speed)));
            double next = u + step * speed;
            // A near-reversal requires a far lower speed than the place one cell before it: cells become shorter towards
            // it.
            for (std::size_t k = cursor; k < last_ && places_[k].u < next; ++k) {
                const double slow = step * std::sqrt(std::max(1e-18, places_[k].square));
                next = std::min(next, u + std::max(slow, slow_approach * (places_[k].u - u)) + slow);
            }
            if (to - next < 0.5 * step * speed) next = to;
            steps.push_back(next - u);
            since += step;
            u = next;
        }
        u = from;
        cursor = first_;
        for (const double step : steps) {
            // The first v² of a cell is feasible at its slowest place.
            double square = infinite;
            for (; cursor < last_ && places_[cursor].u <= u + 0.5 * step; ++cursor)
                square = std::min(square, places_[cursor].square);
            square = std::min(square, square_near(u + 0.5 * step, cursor, from, from_square, to, to_square));
            for (; cursor < last_ && places_[cursor].u < u + step; ++cursor)
                square = std::min(square, places_[cursor].square);
            add_cell(u, step, square);
            u += step;
        }
    }

    void add_cell(double begin, double length, double square) {
        CellLimits limits{infinite, infinite, infinite};
        LimitingFactor why = LimitingFactor::none;
        std::array<AxisSample<5>, samples_of_cell + 1> samples;
        for (std::size_t k = 0; k <= samples_of_cell; ++k) {
            const double at = length * static_cast<double>(k) / samples_of_cell;
            const LimitPlace place = limits_.at(begin + at, samples[k]);
            samples[k].at = at;
            if (place.free_cap < limits.cap) limits.cap = place.free_cap, why = place.why;
            // Near bends an axis may permit more than on a straight path; the exact limit is in its rows.
            limits.acceleration = std::min(limits.acceleration, 2 * place.acceleration);
            limits.jerk = std::min(limits.jerk, 3 * place.jerk);
        }
        problem_.add_cell(length, std::max(square, 1e-18), limits);
        for (const AxisSample<5>& sample : samples) problem_.add_sample(sample);
        cells_.push_back({begin, length, why});
    }

    /// Outputs the solution as motions: all of it, or most.
    void run(bool last) {
        const std::size_t n = cells_.size();
        std::vector<FiveAxisMotion> plan;
        if (first_piece_.duration > 0) plan.push_back(first_piece_);
        KnotState at = start_;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < n; ++i) {
            KnotState next = stop_;
            const double h = cells_[i].length;
            if (i + 1 < n) {
                const double after = cells_[i + 1].length, c0 = problem_.value(i), c1 = problem_.value(i + 1);
                next = {std::sqrt((after * c0 + h * c1) / (h + after)), (c1 - c0) / (h + after)};
            }
            FiveAxisMotion motion;
            motion.begin = cells_[i].begin;
            motion.cell = {h, at.speed, at.acceleration, (next.acceleration - at.acceleration) / h};
            motion.duration = motion.cell.duration();
            motion.limit = limiting(problem_.limiting(i), cells_[i].why);
            if (motion.limit == LimitingFactor::corner_tolerance && bends_as_programmed(cells_[i].begin + 0.5 * h))
                motion.limit = LimitingFactor::jerk;
            plan.push_back(motion);
            at = next;
            if (i < static_cast<std::size_t>(kept_share * static_cast<double>(n))) {
                kept = plan.size();
                state_ = at;
                at_ = cells_[i].begin + h;
            }
        }
        plan.push_back(last_piece_);
        if (last) kept = plan.size();
        motions_.insert(motions_.end(), plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(kept));
        tail_.assign(plan.begin() + static_cast<std::ptrdiff_t>(kept), plan.end());
        const FiveAxisMotion& stop = last_piece_;
        tail_end_ = stop.begin - stop.jerk * stop.duration * stop.duration * stop.duration / 6;
    }

    /// Whether the joint nearest to u is between chords of one block: then its rounding does not depend on a tolerance.
    [[nodiscard]] bool bends_as_programmed(double u) const {
        const std::size_t i = path_->chord_at(u), last = path_->chord_at(path_->length());
        const FiveAxisChord& chord = path_->chord(i);
        const double part = path_->part_at(i, u);
        const bool to_the_end = chord.part_to - part < part - chord.part_from;
        if (to_the_end ? i == last : i == 0) return false;
        return path_->chord(to_the_end ? i + 1 : i - 1).block == chord.block;
    }

    static LimitingFactor limiting(Row row, LimitingFactor at_cap) {
        switch (row) {
            case Row::cap:
            case Row::bend: return at_cap;
            case Row::tangential_acceleration:
            case Row::axis_acceleration: return LimitingFactor::axis_acceleration;
            case Row::bend_jerk: return LimitingFactor::corner_tolerance;
            default: return LimitingFactor::jerk;
        }
    }

    const FiveAxisPath* path_;
    const std::function<Place(std::size_t block)>* place_of_;
    FiveAxisLimits limits_;
    std::vector<LimitPlace> places_;
    RestPieces rests_;
    std::size_t first_ = 0, last_ = 0;  ///< places of the window
    std::vector<FiveAxisCell> cells_;
    AxisSpeedProblem<5> problem_;
    double ramp_;    ///< shortest ramp of the limits [s]
    double at_ = 0;  ///< start of the window
    KnotState state_, start_, stop_;
    FiveAxisMotion first_piece_, last_piece_;
    std::vector<FiveAxisMotion> motions_, tail_;
    double tail_end_ = 0;
};

}  // namespace

double FiveAxisMotion::at(double time, double& speed) const {
    if (jerk == 0) return begin + cell.arc_length_at(time, speed);
    const double from_rest = jerk > 0 ? time : duration - time;
    const double size = std::abs(jerk), distance = size * from_rest * from_rest * from_rest / 6;
    speed = 0.5 * size * from_rest * from_rest;
    return jerk > 0 ? begin + distance : begin + size * duration * duration * duration / 6 - distance;
}

std::vector<FiveAxisMotion> plan_speeds(const FiveAxisPath& path, const Machine& machine,
                                        const std::function<Place(std::size_t block)>& place_of) {
    return FiveAxisPlanner(path, machine, place_of).plan();
}

}  // namespace clsurf
