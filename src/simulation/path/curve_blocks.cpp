#include "simulation/path/curve_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/akima.h"
#include "numeric/least_squares.h"
#include "numeric/speed_intervals.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

// curve_share, most_blocks: docs/simulate.md#2-corner-rounding.
constexpr double curve_share = 0.5;             ///< share of the tolerance that curves may use
constexpr double sharp = std::numbers::pi / 4;  ///< [rad] no curve passes a sharper corner
constexpr std::size_t most_blocks = 1000;       ///< greatest number of blocks of a run; limits how many must be known
constexpr std::size_t windows[] = {10, 5};      ///< blocks per least-squares cubic, tried in turn

/// Upper bound of the distance between a cubic and the line between two points. Uses the distances of the cubic's ends and
/// of the inner Bézier control points, at most 3/4 of which is reached; infinite if the cubic does not run along the line.
double deviation_from(const CubicSpan& curve, const Vec3& begin, const Vec3& end) {
    const Vec3 along = (end - begin).normalized();
    const Vec3 at_begin = curve.derivative(0), at_end = curve.derivative(curve.chord);
    const double ends = std::max((curve.at(0) - begin).norm(), (curve.at(curve.chord) - end).norm());
    if (std::min(at_begin.normalized().dot(along), at_end.normalized().dot(along)) < 0.5)
        return std::numeric_limits<double>::infinity();
    const auto aside = [&](const Vec3& slope) { return (slope - slope.dot(along) * along).norm(); };
    return ends + 0.25 * curve.chord * std::max(aside(at_begin), aside(at_end));
}

}  // namespace

bool CurveBlocks::joins(const PathElement& element) const {
    if (!element.straight() || !std::isfinite(element.feed) || !(element.tolerance > 0)) return false;
    if (run_.empty()) return true;
    return element.tolerance == run_.back().tolerance && deflection(run_.back().direction, element.direction) < sharp;
}

/// Fits cubics to the points. If they deviate too much, uses fewer blocks per cubic, or pins the cubic to the point that is
/// farthest off. If there are too few points, uses a curve through them.
void CurveBlocks::add_fit(std::size_t first, std::size_t last, double allowed) {
    const std::span<const Vec3> points = std::span(points_).subspan(first, last - first + 1);
    std::size_t farthest = 0;
    for (const std::size_t window : windows) {
        if (last - first < window) continue;
        const std::vector<CubicSpan> spans = least_squares_spans(points, window);
        double most = 0;
        for (std::size_t i = 0; i < spans.size(); ++i) {
            const double here = deviation_from(spans[i], points[i], points[i + 1]);
            if (here > most) most = here, farthest = i;
        }
        if (most <= allowed) {
            spans_.insert(spans_.end(), spans.begin(), spans.end());
            return;
        }
    }
    if (last - first < 2 * windows[1]) return add_akima(first, last);
    const std::size_t middle = std::clamp(first + farthest, first + windows[1], last - windows[1]);
    add_fit(first, middle, allowed);
    add_fit(middle, last, allowed);
}

void CurveBlocks::add_akima(std::size_t first, std::size_t last) {
    const std::vector<CubicSpan> spans =
        akima_spans(std::span(points_).subspan(first, last - first + 1), AkimaTangents::unit);
    spans_.insert(spans_.end(), spans.begin(), spans.end());
}

/// Makes the curves of the run, one span per block. Returns the number of finished blocks: if the run continues, its last
/// interval is not finished.
std::size_t CurveBlocks::make_spans(bool goes_on) {
    points_.clear();
    for (const PathElement& line : run_) points_.push_back(line.begin);
    points_.push_back(run_.back().end);
    // Curves are made in a fixed direction, independent of the direction of travel.
    const Vec3 &begin = points_.front(), &end = points_.back();
    const bool back = std::lexicographical_compare(end.begin(), end.end(), begin.begin(), begin.end());
    if (back) std::reverse(points_.begin(), points_.end());
    spans_.clear();
    std::size_t done = run_.size();
    if (mode_ == CurveMode::least_squares) {
        add_fit(0, run_.size(), curve_share * run_.front().tolerance);
    } else {
        IntervalRules rules;
        rules.error = run_.front().tolerance;
        const std::vector<SpeedInterval> intervals = divide(points_, rules);
        for (const SpeedInterval& interval : intervals) add_akima(interval.first, interval.last);
        if (goes_on && intervals.size() > 1)
            done = back ? run_.size() - intervals.front().last : intervals.back().first;
    }
    if (back) {
        std::reverse(spans_.begin(), spans_.end());
        for (CubicSpan& span : spans_)
            span =
                hermite(span.at(span.chord), span.at(0), -span.derivative(span.chord), -span.derivative(0), span.chord);
    }
    return done;
}

/// The blocks of the run, each as its span of a curve unless that exceeds the tolerance.
void CurveBlocks::add_run(bool goes_on) {
    const std::size_t done = make_spans(goes_on);
    for (std::size_t i = 0; i < done; ++i) {
        const PathElement& line = run_[i];
        const double deviation = deviation_from(spans_[i], line.begin, line.end);
        PathElement element = line;
        if (deviation <= curve_share * line.tolerance) {
            element = element_of(spans_[i]);
            element.take_block(line);
            element.deviation = deviation;
        }
        element.tolerance *= 1 - curve_share;
        ready_.push_back(element);
    }
    run_.erase(run_.begin(), run_.begin() + static_cast<std::ptrdiff_t>(done));
}

bool CurveBlocks::next(PathElement& element) {
    while (ready_.empty()) {
        if (!waiting_ && !source_->next(waiting_element_)) {
            if (run_.empty()) return false;
            add_run(false);
            continue;
        }
        waiting_ = true;
        if (!joins(waiting_element_)) {
            if (!run_.empty()) {
                add_run(false);
                continue;
            }
            waiting_element_.tolerance *= 1 - curve_share;
            ready_.push_back(waiting_element_);
            waiting_ = false;
            continue;
        }
        run_.push_back(waiting_element_);
        waiting_ = false;
        if (run_.size() >= most_blocks) add_run(true);
    }
    element = ready_.front();
    ready_.pop_front();
    return true;
}

}  // namespace clsurf
