// Spans of an element. It is divided where a rounding begins, ends or has its middle, so that the position on each span is
// one polynomial (on an arc: added to the arc) and its derivatives can be bounded.

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"
#include "numeric/root_between.h"
#include "simulation/path/arc_steps.h"
#include "simulation/path/junction.h"
#include "simulation/path/path_stream.h"

namespace clsurf {
namespace {

constexpr double least_span = 1e-9;         ///< [mm] closer cuts are merged; ten times the rounding of doubles at 1 km
constexpr double most_turn_of_span = 0.75;  ///< [rad] greatest turn of a span: limits of axes vary with the direction
constexpr double gentle_turn = 0.1;         ///< [rad] a span of a spline that turns less is not divided further …
constexpr double most_bend_ratio = 1.5;     ///< … nor one with a smaller ratio of greatest to least curvature
constexpr int most_spline_halvings = 10;    ///< number of times that a span of a spline is halved
constexpr int checked_points = 5;           ///< points of a span whose greatest values need not be at its ends
constexpr double most_turn_of_step = 0.75;  ///< [rad] of the path between checked points, where it nearly reverses
constexpr double reversal_share = 1e-12;  ///< relative accuracy of the distance to a place where a path nearly reverses
// Distances of cuts to both sides of that place: the first in lengths over which the path turns by 1 rad, then as a factor
// of the last.
constexpr double first_distance = 2, distance_growth = 4;
constexpr double least_pace = 0.1;   ///< share of the shortest checked p′, used if there is no bound
constexpr double nearly = 1 - 1e-9;  ///< share of a limit, to allow for rounding

/// Adds factor · (a + b τ)(c + e τ)³ to a polynomial in τ.
void add_product(std::array<Vec3, 5>& sum, const Vec3& factor, double a, double b, double c, double e) {
    const std::array<double, 4> cube{c * c * c, 3 * c * c * e, 3 * c * e * e, e * e * e};
    for (std::size_t k = 0; k < 4; ++k) {
        sum[k] += a * cube[k] * factor;
        sum[k + 1] += b * cube[k] * factor;
    }
}

/// Adds factor · (w − |d|)³ to a polynomial in τ, whose origin is `distance` after the corner. `side`: 1 after it, −1
/// before it.
template <std::size_t size>
void add_cube(std::array<Vec3, size>& sum, const Vec3& factor, double width, double distance, double side) {
    const double left = width - side * distance;
    sum[0] += left * left * left * factor;
    sum[1] -= 3 * side * left * left * factor;
    sum[2] += 3 * left * factor;
    sum[3] -= side * factor;
}

/// Updates the greatest values on a span with a derivative.
void take(const Vec3& value, Vec3& greatest, double& greatest_length) {
    greatest = greatest.cwiseMax(value.cwiseAbs());
    greatest_length = std::max(greatest_length, value.squaredNorm());
}

/// Bounds of |p′|′ = p′·p″/|p′| and of |p′|″ = (|p″|² − |p′|′²)/|p′| + p′·p‴/|p′| from the Bézier points of p′, p″ and p‴:
/// a product is at most the greatest product of the points of its factors.
void bound_pace(Span& span, const std::array<Vec3, 4>& first, const std::array<Vec3, 3>& second,
                const std::array<Vec3, 2>& third) {
    // |p′| is at least the component of p′ in any direction; the direction of the shortest point is used.
    const Vec3& shortest = *std::min_element(
        first.begin(), first.end(), [](const Vec3& a, const Vec3& b) { return a.squaredNorm() < b.squaredNorm(); });
    const double length = shortest.norm();
    double least = length;
    for (const Vec3& point : first) least = std::min(least, point.dot(shortest) / length);
    if (!(least > 0)) least = least_pace * length;
    double slope = 0, twist = 0;
    for (const Vec3& point : first) {
        for (const Vec3& other : second) slope = std::max(slope, std::abs(point.dot(other)));
        for (const Vec3& other : third) twist = std::max(twist, std::abs(point.dot(other)));
    }
    span.pace_slope = std::min(slope / least, span.greatest_second);
    span.swing = span.greatest_second * span.greatest_second / least;
    span.pace_curve = span.swing + twist / least;
}

/// Greatest values on a rounded line, where derivatives are polynomials: at most those of their Bézier points.
void bound_line(Span& span) {
    const double l = span.length;
    const std::array<Vec3, 5>& c = span.rounding;
    const Vec3 slope = span.base.direction + c[1];
    const Vec3 linear = 2 * l * c[2], square = 3 * l * l * c[3], cube = 4 * l * l * l * c[4];
    take(slope, span.first, span.greatest_first);
    take(slope + linear / 3, span.first, span.greatest_first);
    take(slope + linear * (2.0 / 3) + square / 3, span.first, span.greatest_first);
    take(slope + linear + square + cube, span.first, span.greatest_first);
    const Vec3 bend = 2 * c[2], bend_linear = 6 * l * c[3], bend_square = 12 * l * l * c[4];
    take(bend, span.second, span.greatest_second);
    take(bend + 0.5 * bend_linear, span.second, span.greatest_second);
    take(bend + bend_linear + bend_square, span.second, span.greatest_second);
    span.greatest_first = std::sqrt(span.greatest_first);
    span.greatest_second = std::sqrt(span.greatest_second);
    span.third = (6 * c[3]).cwiseAbs().cwiseMax((6 * c[3] + 24 * l * c[4]).cwiseAbs());
    span.fourth = 24 * c[4].norm();
    bound_pace(
        span, {slope, slope + linear / 3, slope + linear * (2.0 / 3) + square / 3, slope + linear + square + cube},
        {bend, bend + 0.5 * bend_linear, bend + bend_linear + bend_square}, {6 * c[3], 6 * c[3] + 24 * l * c[4]});
}

/// Divides a spline if a span would turn too far, or if its curvature would vary too much for one speed.
void divide_spline(const PathElement& base, double from, double to, int depth, std::vector<double>& cuts) {
    if (depth == most_spline_halvings) return;
    double least = infinite, most = 0;
    for (int k = 0; k < checked_points; ++k) {
        const double bend = base.second_derivative(from + (to - from) * k / (checked_points - 1)).norm();
        least = std::min(least, bend);
        most = std::max(most, bend);
    }
    const double turns = most * (to - from);
    if (turns <= most_turn_of_span && (turns <= gentle_turn || most <= most_bend_ratio * least)) return;
    const double middle = 0.5 * (from + to);
    divide_spline(base, from, middle, depth + 1, cuts);
    cuts.push_back(middle);
    divide_spline(base, middle, to, depth + 1, cuts);
}

/// Greatest values on an arc or a cubic, rounded or not. The third derivative of the rounding is linear, that of an arc
/// nearly so: its greatest value is at a checked point. Between checked points, the lower derivatives change by at most
/// what the next derivative allows.
void bound_curve(Span& span) {
    const double step = span.length / (checked_points - 1);
    std::array<Vec3, checked_points> thirds;
    std::array<Pace, checked_points> paces;
    for (int k = 0; k < checked_points; ++k) {
        const PathDerivatives d = span.derivatives(k * step);
        thirds[static_cast<std::size_t>(k)] = d.third;
        paces[static_cast<std::size_t>(k)] = pace_of(d);
        take(d.first, span.first, span.greatest_first);
        take(d.second, span.second, span.greatest_second);
        span.third = span.third.cwiseMax(d.third.cwiseAbs());
    }
    span.greatest_first = std::sqrt(span.greatest_first);
    span.greatest_second = std::sqrt(span.greatest_second);
    if (span.base.arc) {
        const double turn = span.base.rate * step;  // between checked points
        const double rate = span.base.rate;
        const double margin = 0.125 * turn * turn *
                              (span.base.radius + std::abs(span.base.growth * span.base.length * rate)) * rate * rate *
                              rate;
        span.third.array() += (span.base.first.cwiseAbs() + span.base.second.cwiseAbs()).array().min(1.0) * margin;
    }
    span.fourth = 24 * span.rounding[4].norm() + (span.base.arc ? span.base.radius * std::pow(span.base.rate, 4) : 0.0);
    if (span.base.cubic || span.base.spline) {
        // As a function of arc length a cubic is not a polynomial: differences replace the derivatives, and are doubled for
        // safety.
        Vec3 margin = Vec3::Zero();
        for (std::size_t k = 1; k < thirds.size(); ++k) {
            span.fourth = std::max(span.fourth, 2 * (thirds[k] - thirds[k - 1]).norm() / step);
            if (k + 1 < thirds.size())
                margin = margin.cwiseMax((thirds[k - 1] - 2 * thirds[k] + thirds[k + 1]).cwiseAbs());
        }
        span.third += 0.25 * margin;
    }
    // Between checked points a function exceeds its values there by at most step²/8 of its second derivative.
    const double curve = step * step / 8;
    span.first += curve * span.third;
    span.greatest_first += curve * span.third.norm();
    span.second.array() += curve * span.fourth;
    span.greatest_second += curve * span.fourth;
    double least = paces.front().value;
    for (const Pace& pace : paces) least = std::min(least, pace.value);
    span.swing = span.greatest_second * span.greatest_second / least;
    if (!span.rounded) return;
    // The derivatives of the pace are nearly quadratic: second differences bound the values between the points.
    double slope_play = 0, curve_play = 0;
    for (std::size_t k = 0; k < paces.size(); ++k) {
        span.pace_slope = std::max(span.pace_slope, std::abs(paces[k].slope));
        span.pace_curve = std::max(span.pace_curve, std::abs(paces[k].curve));
        if (k == 0 || k + 1 == paces.size()) continue;
        slope_play = std::max(slope_play, std::abs(paces[k - 1].slope - 2 * paces[k].slope + paces[k + 1].slope));
        curve_play = std::max(curve_play, std::abs(paces[k - 1].curve - 2 * paces[k].curve + paces[k + 1].curve));
    }
    span.pace_slope += 0.25 * slope_play;
    span.pace_curve += 0.25 * curve_play;
}

/// Cuts around the places where a rounded curve nearly reverses. There |p′| falls and rises by |p″| times the distance, as
/// at a kink: |p′|″ is |p″|²/|p′| at the place and falls with the third power of the distance from it. Checked points that
/// are farther apart miss this peak.
void cut_at_reversals(const Span& span, std::vector<double>& cuts) {
    const auto fall = [&](double tau) {
        const PathDerivatives d = span.derivatives(tau);
        return d.first.dot(d.second);
    };
    const double step = span.length / (checked_points - 1);
    double before = fall(0);
    for (int k = 1; k < checked_points; ++k) {
        const double here = fall(k * step);
        if (before < 0 && here > 0) {
            const double at = root_between((k - 1) * step, before, k * step, here, reversal_share, 0, fall);
            const PathDerivatives d = span.derivatives(at);
            const double pace = d.first.norm(), bend = d.second.norm();
            if (bend * step > most_turn_of_step * pace) {
                for (double distance = std::max(first_distance * pace / bend, least_span); distance < step;
                     distance *= distance_growth) {
                    if (distance < at) cuts.push_back(span.from + at - distance);
                    if (distance < span.length - at) cuts.push_back(span.from + at + distance);
                }
            }
        }
        before = here;
    }
}

}  // namespace

Pace pace_of(const PathDerivatives& derivatives) {
    const double value = derivatives.first.norm();
    // The path reverses at p′ = 0: on both sides its direction is that of p″.
    if (!(value > 0)) return {0, derivatives.second.norm(), derivatives.third.norm()};
    const double slope = derivatives.first.dot(derivatives.second) / value;
    return {value, slope,
            (derivatives.second.squaredNorm() - slope * slope + derivatives.first.dot(derivatives.third)) / value};
}

PathDerivatives Span::derivatives(double tau) const {
    const std::array<Vec3, 5>& c = rounding;
    PathDerivatives d = base.derivatives(from + tau);
    if (!rounded) return d;
    d.first += c[1] + tau * (2 * c[2] + tau * (3 * c[3] + tau * 4 * c[4]));
    d.second += 2 * c[2] + tau * (6 * c[3] + tau * 12 * c[4]);
    d.third += 6 * c[3] + tau * 24 * c[4];
    return d;
}

/// Finds the joints whose roundings reach into an element.
void PathStream::find_roundings(std::int64_t element, double begin, double end) {
    reaching_.clear();
    covering_.fill(Vec3::Zero());
    covered_ = false;
    const std::int64_t high = std::min(element_count_ - 2, element + reach_of_a_joint);
    for (std::int64_t k = std::max(first_joint_, element - 1 - reach_of_a_joint); k <= high; ++k) {
        const Joint& j = joint(k);
        if (j.at + j.reach <= begin || j.at - j.reach >= end) continue;
        if (j.bend_width == 0 && top_ == 0 && j.at - j.width <= begin && j.at + j.width >= end) {
            add_cube(covering_, j.turn_share, j.width, begin - j.at, k < element ? 1.0 : -1.0);
            covered_ = true;
        } else {
            reaching_.push_back(&j);
        }
    }
}

void PathStream::make_spans(std::int64_t element) {
    const PathElement& base = elements_[static_cast<std::size_t>(element - first_element_)];
    const double end = ends_[static_cast<std::size_t>(element - first_element_)];
    const double begin = end - base.length;
    find_roundings(element, begin, end);
    cuts_.clear();
    cuts_.push_back(0);
    cuts_.push_back(base.length);
    const auto cut = [&](double at) {
        if (at - begin > least_span && end - at > least_span) cuts_.push_back(at - begin);
    };
    for (const Joint* j : reaching_) {
        if (j->width > 0) cut(j->at - j->width), cut(j->at + j->width);
        if (j->width > 0 && top_ > 0) cut(j->at - top_ * j->width), cut(j->at + top_ * j->width);
        if (j->bend_width > 0) cut(j->at - j->bend_width), cut(j->at + j->bend_width);
    }
    if (base.spline) {
        divide_spline(base, 0, base.length, 0, cuts_);
    } else if (!base.straight()) {
        const int parts = static_cast<int>(std::ceil(base.turning() / most_turn_of_span));
        for (int k = 1; k < parts; ++k) cuts_.push_back(base.length * k / parts);
    }
    std::sort(cuts_.begin(), cuts_.end());
    if (!base.straight() && (covered_ || !reaching_.empty())) {
        const std::vector<double> ends = cuts_;
        for (std::size_t k = 1; k < ends.size(); ++k) {
            Span span;
            span.base = base;
            span.from = ends[k - 1];
            span.length = ends[k] - span.from;
            if (span.length < least_span) continue;
            add_roundings(span, begin + span.from);
            if (span.rounded) cut_at_reversals(span, cuts_);
        }
        if (cuts_.size() > ends.size()) std::sort(cuts_.begin(), cuts_.end());
    }
    double from = 0;
    for (std::size_t k = 1; k < cuts_.size(); ++k) {
        const bool last = k + 1 == cuts_.size();
        if (cuts_[k] - from < least_span && !last) continue;
        if (!last && base.length - cuts_[k] < least_span) continue;
        Span& span = ready_.emplace_back();
        span.base = base;
        span.from = from;
        span.length = cuts_[k] - from;
        add_roundings(span, begin + from);
        set_limits(span);
        if (span.base.jerk_share < 1) limit_next_to_step(span);
        if (from == 0 && element > 0 && machine_->controller.corner == CornerMode::junction)
            span.begin_cap = junction_speed(joint(element - 1).turn, *machine_);
        from = cuts_[k];
    }
}

/// Adds the roundings of the joints within reach, from `begin` on, and computes the bounds of all derivatives.
void PathStream::add_roundings(Span& span, double begin) const {
    const double middle = begin + 0.5 * span.length;
    std::array<Vec3, 5>& sum = span.rounding;
    const std::array<Vec3, 4>& c = covering_;
    const double from = span.from;
    sum = {c[0] + from * (c[1] + from * (c[2] + from * c[3])), c[1] + from * (2 * c[2] + 3 * from * c[3]),
           c[2] + 3 * from * c[3], c[3], Vec3::Zero()};
    span.rounded = covered_;
    for (const Joint* j : reaching_) {
        const double side = middle > j->at ? 1.0 : -1.0;
        const double distance = begin - j->at;  // of τ = 0
        const double away = std::abs(middle - j->at);
        if (away < j->width) {
            span.rounded = true;
            add_cube(sum, j->turn_share, j->width, distance, side);
            if (away < top_ * j->width) add_cube(sum, -j->turn_share, top_ * j->width, distance, side);
        }
        if (away < j->bend_width) {
            span.rounded = true;
            add_product(sum, j->bend_share, distance, 1, j->bend_width - side * distance, -side);
        }
    }
    if (span.straight()) {
        span.first = span.base.direction.cwiseAbs();
        span.greatest_first = 1;
    } else if (span.base.straight()) {
        bound_line(span);
    } else {
        bound_curve(span);
    }
}

/// Limits next to the step of an arc: on a bend a change of the speed causes jerk, too, 3 y″ v a.
void PathStream::limit_next_to_step(Span& span) const {
    span.free_cap = span.cap;
    span.free_limiting = span.limiting;
    for (int i = 0; i < 3; ++i) {
        const double jerk = ArcSteps::twist_share * machine_->axes[static_cast<std::size_t>(i)].max_jerk;
        if (jerk > 0 && span.second[i] > 0)
            span.acceleration = std::min(span.acceleration, jerk / (3 * span.second[i] * span.cap));
    }
}

void PathStream::set_limits(Span& span) const {
    const PathLimits& path = machine_->path;
    const double override_factor = machine_->controller.feed_override;
    const bool rapid = !std::isfinite(span.base.feed);
    span.cap = path.max_speed / span.greatest_first;
    span.limiting = LimitingFactor::axis_speed;
    const auto limit = [&](double speed, LimitingFactor why) {
        if (speed < span.cap) span.cap = speed, span.limiting = why;
    };
    if (!rapid)
        limit(span.base.feed * override_factor,
              override_factor == 1 ? LimitingFactor::feed : LimitingFactor::feed_override);
    if (machine_->controller.block_time > 0)
        limit(span.base.block_length / machine_->controller.block_time, LimitingFactor::block_time);
    if (machine_->controller.whole_periods && !rapid) {
        const double period = machine_->controller.period;
        const double periods = std::ceil(span.base.block_length / (span.cap * period) * nearly);
        limit(span.base.block_length / (std::max(1.0, periods) * period), LimitingFactor::block_time);
    }
    for (int i = 0; i < 3; ++i) {
        if (span.first[i] > 0)
            limit(machine_->axes[static_cast<std::size_t>(i)].max_speed / span.first[i], LimitingFactor::axis_speed);
    }
    limit(span.base.greatest_speed, LimitingFactor::corner_tolerance);
    span.free_cap = span.cap;
    span.free_limiting = span.limiting;
    span.acceleration = path.max_acceleration;
    span.jerk = path.max_jerk;
    const bool corner = span.rounded && span.base.straight();
    const double twist_share = span.base.jerk_share < 1 && !span.base.corner_arc ? ArcSteps::twist_share : 1;
    for (int i = 0; i < 3; ++i) {
        const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(i)];
        if (span.first[i] > 0) {
            span.acceleration = std::min(span.acceleration, axis.max_acceleration / span.first[i]);
            if (axis.max_jerk > 0)
                span.jerk = std::min(span.jerk, span.base.jerk_share * axis.max_jerk / span.first[i]);
        }
        // Roots are computed only for limits that may be exceeded.
        if (span.second[i] * span.cap * span.cap > nearly * axis.max_acceleration)
            limit(std::sqrt(axis.max_acceleration / span.second[i]), LimitingFactor::axis_acceleration);
        const double jerk = twist_share * axis.max_jerk;
        if (jerk > 0 && span.third[i] * span.cap * span.cap * span.cap > nearly * jerk)
            limit(std::cbrt(jerk / span.third[i]), corner ? LimitingFactor::corner_tolerance : LimitingFactor::jerk);
    }
    if (span.pace_slope * span.cap * span.cap > nearly * path.max_acceleration)
        limit(std::sqrt(path.max_acceleration / span.pace_slope), LimitingFactor::axis_acceleration);
    if (span.pace_curve * span.cap * span.cap * span.cap > nearly * path.max_jerk)
        limit(std::cbrt(path.max_jerk / span.pace_curve),
              corner ? LimitingFactor::corner_tolerance : LimitingFactor::jerk);
    if (limits_jerk_in_bends(*machine_) && span.swing * span.cap * span.cap * span.cap > nearly * path.max_jerk)
        limit(std::cbrt(path.max_jerk / span.swing), corner ? LimitingFactor::corner_tolerance : LimitingFactor::jerk);
    if (span.greatest_second > 0) {
        const double radius = 1 / span.greatest_second;
        limit(arc_speed(radius, path.max_normal_acceleration), LimitingFactor::axis_acceleration);
        limit(chord_speed(radius, machine_->controller.chord_tolerance, machine_->controller.period),
              LimitingFactor::chord_error);
    }
}

}  // namespace clsurf
