// Spans of an element: cut where a rounding begins, ends or turns over, so that on each the position
// is one polynomial (on an arc: besides the arc), and its derivatives can be bounded.

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/junction.h"
#include "motion/path_stream.h"

namespace clsurf {
namespace {

constexpr std::int64_t reach_of_a_joint = PathStream::reach_of_a_joint;
constexpr double least_span = 1e-9;  ///< [mm] nearer cuts are one
constexpr double most_turn = 0.75;   ///< [rad] of a curve in one span: limits of axes change round it
constexpr double share_of_bend = 0.5;  ///< of the jerk that a twist leaves: for accelerating in a bend
// An easing is the greatest speed that leaves these parts of the tangential limits: much, for long
// ramps through bends; little, where speeds stay nearly the same.
struct LeastLeft {
    double acceleration, jerk;
};
constexpr std::array<LeastLeft, Span::easings> least_left{{{0.5, 0.5}, {0.2, 0.3}, {0.1, 0.15}}};
constexpr int checked_points = 5;    ///< of a span whose bounds are not at its ends

/// Adds factor · (a + b τ)(c + e τ)³ to a polynomial in τ.
void add_product(std::array<Vec3, 5>& sum, const Vec3& factor, double a, double b, double c, double e) {
    const std::array<double, 4> cube{c * c * c, 3 * c * c * e, 3 * c * e * e, e * e * e};
    for (std::size_t k = 0; k < 4; ++k) {
        sum[k] += a * cube[k] * factor;
        sum[k + 1] += b * cube[k] * factor;
    }
}

}  // namespace

PathDerivatives Span::derivatives(double tau) const {
    const std::array<Vec3, 5>& c = rounding;
    PathDerivatives d = base.derivatives(from + tau);
    if (!rounded) return d;
    d.first += c[1] + tau * (2 * c[2] + tau * (3 * c[3] + tau * 4 * c[4]));
    d.second += 2 * c[2] + tau * (6 * c[3] + tau * 12 * c[4]);
    d.third += 6 * c[3] + tau * 24 * c[4];
    return d;
}

void PathStream::make_spans(std::int64_t element) {
    const PathElement& base = elements_[static_cast<std::size_t>(element - first_element_)];
    const double end = ends_[static_cast<std::size_t>(element - first_element_)];
    const double begin = end - base.length;
    const std::int64_t low = std::max(first_joint_, element - 1 - reach_of_a_joint);
    const std::int64_t high = std::min(element_count_ - 2, element + reach_of_a_joint);
    cuts_.clear();
    cuts_.push_back(0);
    cuts_.push_back(base.length);
    const auto cut = [&](double at) {
        if (at - begin > least_span && end - at > least_span) cuts_.push_back(at - begin);
    };
    for (std::int64_t k = low; k <= high; ++k) {
        const Joint& j = joint(k);
        const double width = j.width * j.scale;
        if (width > 0) cut(j.at - width), cut(j.at + width);
        if (j.bend_width > 0) cut(j.at - j.bend_width), cut(j.at + j.bend_width);
    }
    if (!base.straight()) {
        const int parts = static_cast<int>(std::ceil(base.turning() / most_turn));
        for (int k = 1; k < parts; ++k) cuts_.push_back(base.length * k / parts);
    }
    std::sort(cuts_.begin(), cuts_.end());
    double from = 0;
    for (std::size_t k = 1; k < cuts_.size(); ++k) {
        const bool last = k + 1 == cuts_.size();
        if (cuts_[k] - from < least_span && !last) continue;
        if (!last && base.length - cuts_[k] < least_span) continue;
        Span span;
        span.base = base;
        span.from = from;
        span.length = cuts_[k] - from;
        add_roundings(span, begin + from, element);
        set_limits(span);
        ready_.push_back(span);
        from = cuts_[k];
    }
}

void PathStream::add_roundings(Span& span, double begin, std::int64_t element) const {
    const double middle = begin + 0.5 * span.length;
    for (Vec3& c : span.rounding) c.setZero();
    const std::int64_t low = std::max(first_joint_, element - 1 - reach_of_a_joint);
    const std::int64_t high = std::min(element_count_ - 2, element + reach_of_a_joint);
    for (std::int64_t k = low; k <= high; ++k) {
        const Joint& j = joint(k);
        const double side = middle > j.at ? 1.0 : -1.0;
        const double distance = begin - j.at;  // of τ = 0
        const double width = j.width * j.scale;
        if (width > 0 && std::abs(middle - j.at) < width) {
            span.rounded = true;
            add_product(span.rounding, j.turn / (6 * width * width), 1, 0, width - side * distance, -side);
        }
        if (j.bend_width > 0 && std::abs(middle - j.at) < j.bend_width) {
            span.rounded = true;
            const double v = j.bend_width;
            add_product(span.rounding, j.bend / (12 * v * v), distance, 1, v - side * distance, -side);
        }
    }
    // The third derivative of what is rounded is linear or constant, that of an arc as good as: its
    // greatest value is at a checked point; those below change between them by no more than the next one allows.
    const double step = span.length / (checked_points - 1);
    const bool plain = span.straight();
    std::array<Vec3, checked_points> thirds;
    for (int k = 0; k < (plain ? 1 : checked_points); ++k) {
        const PathDerivatives d = span.derivatives(k * step);
        thirds[static_cast<std::size_t>(k)] = d.third;
        span.slope = span.slope.cwiseMax(d.first.cwiseAbs());
        span.bend = span.bend.cwiseMax(d.second.cwiseAbs());
        span.twist = span.twist.cwiseMax(d.third.cwiseAbs());
        span.greatest_slope = std::max(span.greatest_slope, d.first.norm());
        span.greatest_bend = std::max(span.greatest_bend, d.second.norm());
    }
    if (plain) return;
    if (span.base.arc) {
        const double turn = span.base.rate * step;  // between checked points
        const double rate = span.base.rate;
        const double play = 0.125 * turn * turn * (span.base.radius + std::abs(span.base.growth * span.base.length * rate)) * rate * rate * rate;
        span.twist.array() += (span.base.first.cwiseAbs() + span.base.second.cwiseAbs()).array().min(1.0) * play;
    }
    double& fourth = span.fourth;
    fourth = 24 * span.rounding[4].norm() + (span.base.arc ? span.base.radius * std::pow(span.base.rate, 4) : 0.0);
    if (span.base.cubic) {
        // By the way a cubic is no polynomial: its differences stand for the derivatives, with as much again.
        Vec3 play = Vec3::Zero();
        for (std::size_t k = 1; k < thirds.size(); ++k) {
            fourth = std::max(fourth, 2 * (thirds[k] - thirds[k - 1]).norm() / step);
            if (k + 1 < thirds.size()) play = play.cwiseMax((thirds[k - 1] - 2 * thirds[k] + thirds[k + 1]).cwiseAbs());
        }
        span.twist += 0.25 * play;
    }
    // Between checked points a function is at most its values there plus step²/8 of its second derivative.
    const double curve = step * step / 8;
    span.slope += curve * span.twist;
    const double greatest_twist = span.twist.norm();
    span.greatest_slope += curve * greatest_twist;
    span.bend.array() += curve * fourth;
    span.greatest_bend += curve * fourth;
}

void PathStream::set_limits(Span& span) const {
    const PathLimits& path = machine_->path;
    const double override_factor = machine_->controller.feed_override;
    const bool rapid = !std::isfinite(span.base.feed);
    span.cap = path.max_speed / span.greatest_slope;
    span.ruling = Ruling::axis_speed;
    const auto limit = [&](double speed, Ruling why) {
        if (speed < span.cap) span.cap = speed, span.ruling = why;
    };
    if (!rapid) limit(span.base.feed * override_factor, override_factor == 1 ? Ruling::feed : Ruling::feed_override);
    if (machine_->controller.block_time > 0) limit(span.base.block_length / machine_->controller.block_time, Ruling::block_time);
    for (int i = 0; i < 3; ++i) {
        if (span.slope[i] > 0) limit(machine_->axes[static_cast<std::size_t>(i)].max_speed / span.slope[i], Ruling::axis_speed);
    }
    limit(span.base.greatest_speed, Ruling::corner_tolerance);
    span.free_cap = span.cap;
    span.free_ruling = span.ruling;
    span.acceleration = path.max_acceleration;
    span.jerk = path.max_jerk;
    const bool corner = span.rounded && span.base.straight();
    for (int i = 0; i < 3; ++i) {
        const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(i)];
        const double jerk = axis.max_jerk > 0 ? axis.max_jerk : std::numeric_limits<double>::infinity();
        if (span.slope[i] > 0) {
            span.acceleration = std::min(span.acceleration, axis.max_acceleration / span.slope[i]);
            span.jerk = std::min(span.jerk, jerk / span.slope[i]);
        }
        if (span.bend[i] > 0) limit(std::sqrt(axis.max_acceleration / span.bend[i]), Ruling::axis_acceleration);
        if (span.twist[i] > 0) limit(std::cbrt(jerk / span.twist[i]), corner ? Ruling::corner_tolerance : Ruling::jerk);
    }
    if (span.greatest_bend > 0) {
        const double radius = 1 / span.greatest_bend;
        limit(arc_speed(radius, path.max_normal_acceleration), Ruling::axis_acceleration);
        limit(chord_speed(radius, machine_->controller.chord_tolerance, machine_->controller.period), Ruling::chord_error);
    }
    // What a speed leaves of the tangential limits. In a bend an acceleration costs jerk too, 3 y″ v a,
    // as much at once as the tangential jerk itself: what the twist leaves is shared between them.
    const auto left = [&](double speed, double& acceleration, double& jerk) {
        acceleration = span.acceleration;
        jerk = span.jerk;
        for (int i = 0; i < 3; ++i) {
            const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(i)];
            if (span.slope[i] > 0) acceleration = std::min(acceleration, (axis.max_acceleration - span.bend[i] * speed * speed) / span.slope[i]);
            if (axis.max_jerk <= 0 || span.bend[i] <= 0) continue;
            const double room = axis.max_jerk - span.twist[i] * speed * speed * speed;
            acceleration = std::min(acceleration, share_of_bend * room / (3 * span.bend[i] * speed));
        }
        acceleration = std::max(acceleration, 0.0);
        for (int i = 0; i < 3; ++i) {
            const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(i)];
            if (axis.max_jerk <= 0 || span.slope[i] <= 0) continue;
            const double room = axis.max_jerk - span.twist[i] * speed * speed * speed;
            jerk = std::min(jerk, (room - 3 * span.bend[i] * speed * acceleration) / span.slope[i]);
        }
    };
    for (std::size_t e = 0; e < least_left.size(); ++e) {
        Span::Easing& eased = span.eased[e];
        const auto enough = [&](double speed) {
            left(speed, eased.acceleration, eased.jerk);
            return eased.acceleration >= least_left[e].acceleration * span.acceleration && eased.jerk >= least_left[e].jerk * span.jerk;
        };
        eased.cap = span.cap;
        if (enough(span.cap)) continue;
        double low = 0;
        double high = span.cap;
        constexpr int halvings = 40;
        for (int k = 0; k < halvings && high - low > 1e-3 * high; ++k) {
            const double middle = 0.5 * (low + high);
            (enough(middle) ? low : high) = middle;
        }
        eased.cap = low;
        left(low, eased.acceleration, eased.jerk);
    }
}

}  // namespace clsurf
