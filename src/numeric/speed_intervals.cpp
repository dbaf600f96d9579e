#include "numeric/speed_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numeric/curvature_steps.h"
#include "numeric/polyline.h"
#include "numeric/resolved_curvature.h"

namespace clsurf {
namespace {

constexpr double least_score = 1 - 1e-9;
constexpr double same_score = 1e-9;
constexpr double closed_share = 1e-6;  ///< share of the pass's extent: a pass is closed if its ends are nearer

void reduce(std::span<const Vec3> points, std::size_t first, std::size_t last, double error,
            std::vector<std::size_t>& kept) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        double farthest = error;
        std::size_t at = from;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double distance = (points[i] - nearest_on_line(points[i], points[from], points[to])).norm();
            if (distance > farthest) farthest = distance, at = i;
        }
        if (at == from) continue;
        kept.push_back(at);
        open.emplace_back(from, at);
        open.emplace_back(at, to);
    }
}

double rounded(double score) { return std::isfinite(score) ? std::round(score / same_score) * same_score : score; }

/// How much a pass changes at its points: 1 and more is a boundary.
class Scores {
public:
    Scores(std::span<const Vec3> points, std::span<const double> curvature, const IntervalRules& rules)
        : points_(points), curvature_(curvature), rules_(rules) {}

    /// Domain: an inner point.
    [[nodiscard]] double at(std::size_t i) const {
        const double length = std::log((points_[i + 1] - points_[i]).norm() / (points_[i] - points_[i - 1]).norm());
        const double before = bend(i - 1), here = bend(i), after = bend(i + 1);
        if (std::isinf(here)) return here;  // turns back
        const double change = std::isinf(before) || std::isinf(after) ? 0 : std::log(after / before);
        const double spike = std::log(here / std::max(before, after));
        const double by_curvature = std::log(rules_.curvature_ratio);
        return rounded(std::max(
            {std::abs(length) / std::log(rules_.length_ratio), std::abs(change) / by_curvature, spike / by_curvature}));
    }

private:
    [[nodiscard]] double bend(std::size_t i) const { return std::max(curvature_[i], rules_.flat_curvature); }

    std::span<const Vec3> points_;
    std::span<const double> curvature_;
    const IntervalRules& rules_;
};

/// Cuts intervals whose curvature drifts by more than the ratio over the inner points, from left to right.
void cut_drifts(std::vector<std::size_t>& boundaries, std::span<const double> curvature, const IntervalRules& rules) {
    std::vector<std::size_t> all{boundaries.front()};
    for (std::size_t k = 1; k < boundaries.size(); ++k) {
        double low = std::numeric_limits<double>::infinity(), high = 0;
        for (std::size_t i = all.back() + 1; i < boundaries[k]; ++i) {
            const double bend = std::max(curvature[i], rules.flat_curvature);
            const double lower = std::min(low, bend), higher = std::max(high, bend);
            if (higher > rules.drift_ratio * lower && std::isfinite(higher)) {
                all.push_back(i);
                low = std::numeric_limits<double>::infinity();
                high = 0;
            } else {
                low = lower;
                high = higher;
            }
        }
        all.push_back(boundaries[k]);
    }
    boundaries = std::move(all);
}

/// Cuts in a direction that does not depend on the direction of travel, so that adjacent passes get the same cuts.
void cut_drifts_either_way(std::vector<std::size_t>& boundaries, std::span<const Vec3> points,
                           std::span<const double> curvature, const IntervalRules& rules) {
    if (!(rules.drift_ratio > 0)) return;
    const Vec3 &begin = points.front(), &end = points.back();
    if (!std::lexicographical_compare(end.begin(), end.end(), begin.begin(), begin.end()))
        return cut_drifts(boundaries, curvature, rules);
    const auto turn_round = [&] {
        std::reverse(boundaries.begin(), boundaries.end());
        for (std::size_t& b : boundaries) b = points.size() - 1 - b;
    };
    turn_round();
    cut_drifts(boundaries, std::vector<double>(curvature.rbegin(), curvature.rend()), rules);
    turn_round();
}

/// Moves boundaries to the points where curvature steps. Returns whether there is any step. Curvature is measured over
/// sections, so a step looks like a drift, and the intervals next to it are cut. `cut`: the boundaries with these cuts; each
/// of them is searched for a step nearby. Curvature on each side of a step is then measured again, from the points of that
/// side alone.
bool move_to_steps(std::vector<std::size_t>& boundaries, const std::vector<std::size_t>& cut,
                   std::span<const Vec3> points, std::span<double> curvature, const IntervalRules& rules) {
    std::vector<std::size_t> kept{boundaries.front()}, steps;
    for (std::size_t k = 1; k + 1 < cut.size(); ++k) {
        const auto after = std::upper_bound(boundaries.begin(), boundaries.end(), cut[k]);
        const auto before = std::lower_bound(boundaries.begin(), boundaries.end(), cut[k]) - 1;
        const std::optional<std::size_t> step =
            curvature_step_near(points, curvature, cut[k], *before, *after, rules.coordinate_step);
        if (step)
            steps.push_back(*step);
        else if (*(after - 1) == cut[k])
            kept.push_back(cut[k]);
    }
    if (steps.empty()) return false;
    kept.push_back(boundaries.back());
    steps.push_back(boundaries.back());
    std::sort(steps.begin(), steps.end());
    std::size_t first = boundaries.front();
    for (const std::size_t last : steps) {
        if (last <= first) continue;
        const std::vector<double> own = curvatures(points.subspan(first, last - first + 1), rules);
        for (std::size_t i = first + 1; i < last; ++i) curvature[i] = own[i - first];
        first = last;
    }
    boundaries = std::move(kept);
    boundaries.insert(boundaries.end(), steps.begin(), steps.end());
    std::sort(boundaries.begin(), boundaries.end());
    boundaries.erase(std::unique(boundaries.begin(), boundaries.end()), boundaries.end());
    return true;
}

/// Divides intervals that are too long into equal parts.
void cut_lengths(std::vector<std::size_t>& boundaries, std::span<const Vec3> points, double longest) {
    std::vector<std::size_t> all{boundaries.front()};
    for (std::size_t k = 1; k < boundaries.size(); ++k) {
        double whole = 0;
        for (std::size_t i = boundaries[k - 1]; i < boundaries[k]; ++i) whole += (points[i + 1] - points[i]).norm();
        const double part = whole / std::max(std::ceil(whole / longest), 1.0);
        double arc_length = 0;
        for (std::size_t i = boundaries[k - 1] + 1; i < boundaries[k]; ++i) {
            const double before = arc_length;
            arc_length += (points[i] - points[i - 1]).norm();
            if (std::floor(arc_length / part) > std::floor(before / part)) all.push_back(i);
        }
        all.push_back(boundaries[k]);
    }
    boundaries = std::move(all);
}

}  // namespace

std::vector<double> curvatures(std::span<const Vec3> points) {
    const std::size_t n = points.size();
    std::vector<double> result(n, 0);
    if (n < 3) return result;
    for (std::size_t i = 1; i + 1 < n; ++i) result[i] = three_point_curvature(points[i - 1], points[i], points[i + 1]);
    result.front() = result[1];
    result.back() = result[n - 2];
    return result;
}

std::vector<std::size_t> characteristic_points(std::span<const Vec3> points, double error) {
    if (points.empty()) return {};
    const std::size_t last = points.size() - 1;
    std::vector<std::size_t> kept{0};
    if (last == 0) return kept;
    kept.push_back(last);
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < last; ++i) {
        if ((points[i] - points[0]).norm() > (points[farthest] - points[0]).norm()) farthest = i;
    }
    const double extent = (points[farthest] - points[0]).norm();
    if (farthest > 0 && (points[last] - points[0]).norm() <= closed_share * extent) {
        kept.push_back(farthest);
        reduce(points, 0, farthest, error, kept);
        reduce(points, farthest, last, error, kept);
    } else {
        reduce(points, 0, last, error, kept);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

std::vector<std::size_t> interval_boundaries(std::span<const Vec3> points, std::span<const double> curvature,
                                             const IntervalRules& rules) {
    const std::vector<std::size_t> corners = characteristic_points(points, rules.error);
    if (corners.size() < 2) return corners;
    const Scores scores(points, curvature, rules);
    // A step of curvature shows at two neighbouring points: of a run of such points, take the one that changes most.
    struct Choice {
        std::size_t corner = 0;
        double score = 0;
    };
    std::vector<Choice> chosen;
    std::size_t run_end = 0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const double score = scores.at(corners[k]);
        if (score < least_score) continue;
        const bool same_run = !chosen.empty() && corners[k] == run_end + 1;
        if (!same_run)
            chosen.push_back({k, score});
        else if (score > chosen.back().score)
            chosen.back() = {k, score};
        run_end = corners[k];
    }
    std::vector<std::size_t> boundaries{corners.front()};
    for (const Choice& choice : chosen) {
        const std::size_t at = corners[choice.corner];
        const std::size_t first = at - (at - corners[choice.corner - 1]) / 2,
                          last = at + (corners[choice.corner + 1] - at) / 2;
        std::size_t best = at;
        double most = choice.score;
        for (std::size_t i = std::max<std::size_t>(first, 1); i <= last && i + 1 < points.size(); ++i) {
            if (const double score = scores.at(i); score > most) best = i, most = score;
        }
        if (best > boundaries.back()) boundaries.push_back(best);
    }
    if (boundaries.back() == corners.back()) return boundaries;
    boundaries.push_back(corners.back());
    return boundaries;
}

std::vector<double> curvatures(std::span<const Vec3> points, const IntervalRules& rules) {
    return rules.coordinate_step > 0 ? resolved_curvatures(points, rules.coordinate_step, rules.flat_curvature)
                                     : curvatures(points);
}

std::vector<std::size_t> all_boundaries(std::span<const Vec3> points, std::span<double> curvature,
                                        const IntervalRules& rules) {
    std::vector<std::size_t> boundaries = interval_boundaries(points, curvature, rules);
    if (boundaries.size() < 2) return boundaries;
    std::vector<std::size_t> cut = boundaries;
    cut_drifts_either_way(cut, points, curvature, rules);
    if (rules.coordinate_step > 0 && move_to_steps(boundaries, cut, points, curvature, rules)) {
        cut = boundaries;
        cut_drifts_either_way(cut, points, curvature, rules);
    }
    if (rules.greatest_length > 0) cut_lengths(cut, points, rules.greatest_length);
    return cut;
}

std::vector<SpeedInterval> intervals_between(std::span<const Vec3> points, std::span<const double> curvature,
                                             std::span<const std::size_t> boundaries) {
    std::vector<SpeedInterval> intervals;
    for (std::size_t k = 1; k < boundaries.size(); ++k) {
        SpeedInterval interval{boundaries[k - 1], boundaries[k], 0, 0};
        double sum = 0, arc_length = 0;
        for (std::size_t i = interval.first + 1; i < interval.last; ++i) {
            const double mine = 0.5 * ((points[i] - points[i - 1]).norm() + (points[i + 1] - points[i]).norm());
            sum += curvature[i] * mine;
            arc_length += mine;
            interval.greatest_curvature = std::max(interval.greatest_curvature, curvature[i]);
        }
        if (arc_length > 0) interval.mean_curvature = sum / arc_length;
        intervals.push_back(interval);
    }
    return intervals;
}

std::vector<SpeedInterval> divide(std::span<const Vec3> points, const IntervalRules& rules) {
    if (points.size() < 2) return {};
    std::vector<double> curvature = curvatures(points, rules);
    const std::vector<std::size_t> boundaries = all_boundaries(points, curvature, rules);
    return intervals_between(points, curvature, boundaries);
}

}  // namespace clsurf
