#include "simulation/plan/scan_driver.h"

#include <algorithm>
#include <cmath>

#include "simulation/path/junction.h"
#include "simulation/plan/lookahead_window.h"

namespace clsurf {
namespace {

// Cells of a twentieth of a period would shorten a run by 0.26 % (docs/experiments/simulation.md#comparison-with-the-optimum).
constexpr double periods_a_cell = 0.5;  ///< periods per cell on a bent span, at its greatest speed
constexpr int most_cells_of_span = 16;
// Between two places at the distance Δ an acceleration x′ a + x″ v² differs from linear interpolation by at most Δ²/8 of
// its second derivative, 5 x‴ a + x⁗ v². This margin is left at the places, and their distance is chosen accordingly:
constexpr double left_over = 0.005;         ///< share of an acceleration for the margin
constexpr double least_acceleration = 0.5;  ///< share of an acceleration that remains in any case
constexpr double most_turn = 0.1;           ///< [rad] greatest turn of the path between two places
constexpr int most_parts = 8;               ///< parts of a cell between its places
constexpr double share_held = 1 + 1e-9;     ///< share of an acceleration that counts as kept halfway between two places
constexpr int most_iterations = 8;          ///< plans after which limits are added for accelerations that exceed it

}  // namespace

bool ScanDriver::take_span() {
    const Span* span = stream_->next();
    if (span == nullptr) return false;
    spans_.push_back(*span);
    divide(spans_.back());
    return true;
}

/// Upper bound of the second derivative of an axis' acceleration, from the greatest x‴ and x⁗ [1/(mm s²)].
Vec3 ScanDriver::curving(const Span& span) const {
    const double fastest =
        std::min(span.free_cap, arc_speed(1 / span.greatest_second, machine_->path.max_normal_acceleration));
    return (5 * machine_->path.max_acceleration * span.third).array() + fastest * fastest * span.fourth;
}

/// Whether no limit of an axis or the path is reached on a span while the tangential acceleration stays within the limit
/// for a straight path.
bool ScanDriver::gentle(const Span& span) const {
    if (span.straight()) return true;
    if (span.cap < span.free_cap) return false;
    for (int x = 0; x < 3; ++x) {
        const double bending = span.second[x] * span.cap * span.cap;
        if (span.first[x] * span.acceleration + bending > machine_->axes[static_cast<std::size_t>(x)].max_acceleration)
            return false;
    }
    return span.greatest_first * span.acceleration + span.pace_slope * span.cap * span.cap <=
           machine_->path.max_acceleration;
}

void ScanDriver::divide(const Span& span) {
    const auto limit_begin = [&] {
        if (std::isfinite(span.begin_cap)) scan_.limit_begin(span.begin_cap);
    };
    if (gentle(span)) {
        scan_.add_cell(span.length, span.free_cap, span.acceleration);
        limit_begin();
        cells_.push_back({&span, 0, span.free_limiting, span.length, 0});
        return;
    }
    // A single cell cannot lead from rest to rest.
    const double fewest = cells_.empty() || std::isfinite(span.begin_cap) ? 2 : 1;
    const int count =
        static_cast<int>(std::clamp(std::ceil(span.length / (span.cap * machine_->controller.period * periods_a_cell)),
                                    fewest, double{most_cells_of_span}));
    const double length = span.length / count;
    const Vec3 curving = this->curving(span);
    double steepest = 0;
    for (int x = 0; x < 3; ++x)
        steepest = std::max(steepest, curving[x] / machine_->axes[static_cast<std::size_t>(x)].max_acceleration);
    if (span.rounded) steepest = std::max(steepest, curving.norm() / machine_->path.max_acceleration);
    const auto parts = static_cast<std::size_t>(
        std::clamp(std::ceil(length * std::sqrt(steepest / (8 * left_over))), 1.0, double{most_parts}));
    const double part = length / static_cast<double>(parts);
    Vec3 limits;
    for (int x = 0; x < 3; ++x) {
        const double greatest = machine_->axes[static_cast<std::size_t>(x)].max_acceleration;
        limits[x] = std::max(greatest - part * part / 8 * curving[x], least_acceleration * greatest);
    }
    places_.resize(parts + 1);
    places_[parts] = span.derivatives(0);
    for (int k = 0; k < count; ++k) {
        places_[0] = places_[parts];
        for (std::size_t p = 1; p <= parts; ++p)
            places_[p] = span.derivatives(length * k + part * static_cast<double>(p));
        add_cell({&span, length * k, span.free_limiting, length, parts}, limits);
        if (k == 0) limit_begin();
    }
}

/// Adds a cell with places_ along it, at which the axes keep these accelerations.
void ScanDriver::add_cell(Cell cell, const Vec3& accelerations) {
    const PathLimits& path = machine_->path;
    double cap = cell.span->free_cap;
    const auto limit = [&](double speed, LimitingFactor why) {
        if (speed < cap) cap = speed, cell.at_cap = why;
    };
    double bend = 0;
    for (const PathDerivatives& place : places_) bend = std::max(bend, place.second.squaredNorm());
    if (bend > 0) {
        const double radius = 1 / std::sqrt(bend);
        limit(arc_speed(radius, path.max_normal_acceleration), LimitingFactor::axis_acceleration);
        limit(chord_speed(radius, machine_->controller.chord_tolerance, machine_->controller.period),
              LimitingFactor::chord_error);
    }
    cells_.push_back(cell);
    scan_.add_cell(cell.length, cap, path.max_acceleration);
    const double part = cell.length / static_cast<double>(cell.parts);
    for (std::size_t p = 0; p < places_.size(); ++p) {
        for (int x = 0; x < 3; ++x)
            scan_.add_limit(part * static_cast<double>(p), places_[p].first[x], places_[p].second[x], accelerations[x]);
    }
    if (cell.span->rounded) limit_path(*cell.span, part);
}

/// Adds the limit of the tangential acceleration to the last cell, at places_ with the distance `part`.
void ScanDriver::limit_path(const Span& span, double part) {
    const double greatest = machine_->path.max_acceleration;
    const double held = std::max(greatest - part * part / 8 * curving(span).norm(), least_acceleration * greatest);
    for (std::size_t p = 0; p < places_.size(); ++p)
        limit_path_at(cells_.size() - 1, part * static_cast<double>(p), places_[p], part, held);
}

/// Adds the limit at a place of a cell; the distance to the next place is `part`.
void ScanDriver::limit_path_at(std::size_t cell, double at, const PathDerivatives& place, double part,
                               double acceleration) {
    const Pace pace = pace_of(place);
    const double bend = place.second.norm();
    if (bend * part <= most_turn * pace.value) {
        scan_.add_limit(cell, at, pace.value, pace.slope, acceleration);
        return;
    }
    // If the path nearly reverses, |p′|′ changes its sign between two places: its bound is used.
    scan_.add_limit(cell, at, pace.value, bend, acceleration);
    scan_.add_limit(cell, at, pace.value, -bend, acceleration);
}

/// Whether the plan keeps the limits of acceleration at a place of a cell.
bool ScanDriver::holds(std::size_t cell, double at, const PathDerivatives& place) const {
    const double acceleration = scan_.acceleration(cell), before = scan_.speed(cell);
    const double square = before * before + 2 * acceleration * at;
    for (int x = 0; x < 3; ++x) {
        if (std::abs(place.first[x] * acceleration + place.second[x] * square) >
            share_held * machine_->axes[static_cast<std::size_t>(x)].max_acceleration)
            return false;
    }
    if (!cells_[cell].span->rounded) return true;
    const Pace pace = pace_of(place);
    return std::abs(pace.value * acceleration + pace.slope * square) <= share_held * machine_->path.max_acceleration;
}

/// Adds limits halfway between the places of the cells if the plan exceeds them there. False: it exceeds none.
bool ScanDriver::limit_between() {
    bool broken = false;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const Cell& cell = cells_[i];
        if (cell.parts == 0 || !scan_.has_limits(i)) continue;
        const double part = cell.length / static_cast<double>(cell.parts);
        for (std::size_t p = 0; p < cell.parts; ++p) {
            const double at = part * (static_cast<double>(p) + 0.5);
            const PathDerivatives place = cell.span->derivatives(cell.from + at);
            if (holds(i, at, place)) continue;
            broken = true;
            for (int x = 0; x < 3; ++x)
                scan_.add_limit(i, at, place.first[x], place.second[x],
                                machine_->axes[static_cast<std::size_t>(x)].max_acceleration);
            if (cell.span->rounded) limit_path_at(i, at, place, 0.5 * part, machine_->path.max_acceleration);
        }
    }
    return broken;
}

/// An exchange method (Hettich and Kortanek 1993): limits are added until the plan exceeds none.
void ScanDriver::plan(double speed) {
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        scan_.plan(speed);
        if (!limit_between()) return;
    }
    scan_.plan(speed);  // with all added limits
}

void ScanDriver::run_section(const std::function<void()>& report) {
    spans_.clear();
    cells_.clear();
    scan_.clear();
    LookaheadWindow window(machine_->controller, machine_->controller.lookahead_blocks);
    double speed = 0;
    bool ended = false;
    while (!ended || !cells_.empty()) {
        window.begin(spans_);
        while (!ended && (spans_.empty() || window.takes_more(spans_.front(), spans_.back()))) {
            ended = !take_span();
            if (!ended) window.count(spans_.front(), spans_.back());
        }
        if (cells_.empty()) return;
        std::size_t count = cells_.size();
        if (!ended) {
            const std::int64_t kept = window.first_kept(spans_.front(), spans_.back());
            count = 1;
            while (count + 1 < cells_.size() && cells_[count].span->base.block < kept) ++count;
        }
        plan(speed);
        speed = scan_.speed(count);
        run(count);
        report();
    }
}

/// Runs the first cells and removes them.
void ScanDriver::run(std::size_t count) {
    // The cells that brake to the end of the known path.
    std::size_t braking = scan_.size();
    while (braking > 0 && scan_.speed(braking) < scan_.speed(braking - 1)) --braking;
    for (std::size_t i = 0; i < count; ++i) {
        const Cell& cell = cells_[i];
        scan_.motions(i, motions_);
        double from = cell.from;
        for (const CellMotion& motion : motions_) {
            const bool last_arc_length = i >= braking || (i + 1 == braking && motion.acceleration < 0);
            const LimitingFactor limiting = scan_.at_cap(i, motion) ? cell.at_cap
                                            : last_arc_length && motion.acceleration < 0
                                                ? LimitingFactor::lookahead_end
                                                : LimitingFactor::axis_acceleration;
            const CellPart part{cell.span, from, motion.length};
            sink_->run(motion, {&part, 1}, limiting);
            from += motion.length;
        }
    }
    cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count));
    scan_.drop_front(count);
    const Span* first = cells_.empty() ? nullptr : cells_.front().span;
    while (!spans_.empty() && &spans_.front() != first) spans_.pop_front();
}

}  // namespace clsurf
