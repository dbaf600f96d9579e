#include "predictor/mismatch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/block.h"
#include "core/not_finite.h"
#include "core/statistics.h"
#include "predictor/judged_neighbours.h"
#include "predictor/oblique_alignment.h"
#include "predictor/residual.h"

namespace clsurf {
namespace {

// A bound on the time. Of 50,000 independent samples, the 99th percentile has a standard error of 0.04 percentage points.
constexpr std::size_t sampled_points = 50'000;
constexpr float round_a_corner = 0.5F;    ///< cos 60°: straight across a corner, passes turn by more than this
constexpr float slack_step_overs = 0.5F;  ///< along the feed: largest distance between ends that are side by side
// Three times, as in docs/design/predictor.md#1-compare-adjacent-passes, Residual.
constexpr float clear_of_scatter = 3;  ///< times the scatter of the motions of the passes around a place near a border

/// The compared quantities of a missing pass.
Compared no_pass() {
    return {missing<float>, missing<float>, missing<float>, Eigen::Vector3f::Constant(missing<float>)};
}

bool runs_against(const Signals& signals, PointIndex point, const PathLocation& at) {
    return signals.feed(at.nearest()).dot(signals.feed(point)) < 0;
}

float larger(float a, float b) { return !(a == a) || b > a ? b : a; }

/// The step from a pass to the adjacent one, minus the trend from there to the next: an even change from pass to pass is no
/// step. `next` NaN: there is none.
float step_beyond_trend(float own, float adjacent, float next) {
    const float step = own - adjacent, trend = adjacent - next;
    if (!(trend * step > 0)) return std::abs(step);
    return std::max(0.0F, std::abs(step) - std::abs(trend));
}
float step_beyond_trend(const Eigen::Vector3f& own, const Eigen::Vector3f& adjacent, const Eigen::Vector3f& next) {
    const Eigen::Vector3f step = own - adjacent;
    const float along = step.dot(adjacent - next);
    const float length = step.norm();
    if (!(along > 0)) return length;
    return std::max(0.0F, length - along / length);
}

/// Change of a signal over two periods at a point: on each of two passes, commanded and measured positions of a record may be
/// one period apart.
float change_of_two_periods(const Signals& signals, float Sample::*signal, PointIndex point) {
    constexpr PointIndex reach = 3;
    if (point < reach || point + reach >= signals.size()) return 0;
    const float change = std::abs(signals[point + reach].*signal - signals[point - reach].*signal) / reach;
    return change == change ? change : 0;
}

float quantile(std::vector<float>& values, double share) {
    return values.empty() ? missing<float> : quantile_below(values, share);
}

/// Calls f(points) for all points of a log. If `forget` is set, in portions, and signals are forgotten between them.
template <typename F>
void in_portions(PointIndex count, const std::function<void()>& forget, F&& f) {
    // Memory and time depend on it, results do not.
    constexpr PointIndex portion = 256 * block_points;
    if (!forget) return f(PointRange{0, count - 1});
    for (PointIndex first = 0; first < count; first += portion) {
        f(PointRange{first, std::min(count, first + portion) - 1});
        forget();
    }
}

/// Evenly spaced judged points, some `sampled_points`. O(points), parallel.
std::vector<PointIndex> sample_judged(const Signals& signals, const std::function<void()>& forget) {
    const PointIndex count = signals.size();
    const auto block_of = [](PointIndex first) { return static_cast<std::size_t>(first / block_points); };
    std::vector<PointIndex> before(block_of(count + block_points - 1) + 1);  // judged points before each block
    Column<std::uint64_t> judged(static_cast<std::size_t>((count + 63) / 64), 0);
    in_portions(count, forget, [&](const PointRange& portion) {
        for_each_block(portion, [&](PointIndex first, PointIndex last) {
            for (PointIndex i = first; i < last; ++i) {
                if (signals.without_heights(i).zone == Zone::outside) continue;
                judged[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
                ++before[block_of(first) + 1];
            }
        });
    });
    std::partial_sum(before.begin(), before.end(), before.begin());
    const PointIndex stride = std::max<PointIndex>(1, before.back() / static_cast<PointIndex>(sampled_points));
    std::vector<PointIndex> points(static_cast<std::size_t>((before.back() + stride - 1) / stride));
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        PointIndex seen = before[block_of(first)];
        for (PointIndex word = first / 64; word * 64 < last; ++word) {
            for (std::uint64_t left = judged[static_cast<std::size_t>(word)]; left != 0; left &= left - 1, ++seen) {
                if (seen % stride == 0)
                    points[static_cast<std::size_t>(seen / stride)] = word * 64 + std::countr_zero(left);
            }
        }
    });
    return points;
}

/// Calls f(k) for all of `points`, which ascend; in parallel, and in portions.
template <typename F>
void for_each_sample(const std::vector<PointIndex>& points, PointIndex count, const std::function<void()>& forget,
                     F&& f) {
    in_portions(count, forget, [&](const PointRange& portion) {
        const auto begin = std::lower_bound(points.begin(), points.end(), portion.first) - points.begin();
        const auto end = std::upper_bound(points.begin(), points.end(), portion.last) - points.begin();
        parallel_for(end - begin, 4096, [&](std::int64_t first, std::int64_t last) {
            for (auto k = static_cast<std::size_t>(begin + first); k < static_cast<std::size_t>(begin + last); ++k)
                f(k);
        });
    });
}

/// The values that are known.
template <typename Value>
std::vector<float> known(std::size_t count, Value&& value) {
    std::vector<float> values;
    values.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const float v = value(k);
        if (v == v) values.push_back(v);
    }
    return values;
}

/// The passes on the left and on the right of a place, the adjacent one first.
struct SurroundingPasses {
    std::array<std::array<Compared, passes_around_border>, 2> of;
    std::array<int, 2> count{0, 0};
};

/// The values of `read` for the passes on either side.
class SurroundingValues {
public:
    template <typename Read>
    SurroundingValues(const SurroundingPasses& others, Read&& read) : count_(others.count) {
        for (std::size_t s = 0; s < 2; ++s) {
            for (std::size_t k = 0; k < static_cast<std::size_t>(count_[s]); ++k) values_[s][k] = read(others.of[s][k]);
        }
    }
    [[nodiscard]] std::span<const float> side(std::size_t s) const {
        return std::span(values_[s]).first(static_cast<std::size_t>(count_[s]));
    }
    [[nodiscard]] float usual(float own) const { return usual_around(own, side(0), side(1)); }
    /// The same for a motion: speeds change from pass to pass where passes become shorter or more curved.
    [[nodiscard]] float usual_motion(float own) const { return usual_around(own, side(0), side(1), clear_of_scatter); }

private:
    std::array<int, 2> count_;
    std::array<std::array<float, passes_around_border>, 2> values_;
};

/// Sets residuals against the adjacent passes, and the jump of the speed. Returns the reference speed of relative differences
/// [mm/s].
float fill_residuals(const Compared& mine, const SurroundingPasses& others, float least_speed, Comparison& result) {
    const SurroundingValues speeds(others, [](const Compared& v) { return v.speed; });
    const SurroundingValues deviations(others, [](const Compared& v) { return v.normal_deviation; });
    const SurroundingValues reliefs(others, [](const Compared& v) { return v.relief; });
    const float usual = speeds.usual_motion(mine.speed);
    // The reference for two passes is the mean of both.
    const bool two = others.count[0] == 1 && others.count[1] == 1;
    const float of_two = two ? 0.5F * (others.of[0][0].speed + others.of[1][0].speed) : usual;
    const float reference = std::max(of_two == of_two ? of_two : mine.speed, least_speed);
    result.speed_jump = mine.speed - usual;
    result.residual[index_of(Quantity::speed)] = result.speed_jump / reference;
    result.residual[index_of(Quantity::normal_deviation)] =
        mine.normal_deviation - deviations.usual(mine.normal_deviation);
    // The curvature of a part changes over more passes than a motion does, so at most five count.
    const auto nearest = [&](std::size_t s) {
        const std::span<const float> all = reliefs.side(s);
        return all.first(std::min<std::size_t>(all.size(), Comparer::passes_aside));
    };
    result.residual[index_of(Quantity::relief)] = relief_mark(mine.relief, nearest(0), nearest(1));
    Eigen::Vector3f consensus;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const SurroundingValues along(others, [axis](const Compared& v) { return v.acceleration[axis]; });
        consensus[axis] = along.usual_motion(mine.acceleration[axis]);
    }
    result.residual[index_of(Quantity::acceleration)] = (mine.acceleration - consensus).norm();
    return reference;
}

}  // namespace

void Comparer::compare_obliquely_around(const PathLocation& here, Comparison& comparison) const {
    constexpr int aside = 3;
    std::array<AdjacentPlace, 2 * aside> places;
    std::size_t count = 0;
    for (const Side side : {Side::left, Side::right}) {
        for_each_judged_neighbour(surface_, signals_, here, side, aside, round_a_corner,
                                  [&](const PathLocation& at, int passes) {
                                      places[count++] = {at, side == Side::left ? passes : -passes};
                                  });
    }
    const std::optional<ObliqueComparison> oblique =
        compare_obliquely(surface_, signals_, here, std::span(places).first(count));
    if (!oblique) return;
    const Compared mine = compared_at(signals_, here, signals_.normal(here.nearest()));
    const float reference = std::max(oblique->speed, least_speed_);
    const auto lessen = [&](Quantity q, float residual, float step) {
        if (std::abs(residual) < std::abs(comparison.residual[index_of(q)]))
            comparison.residual[index_of(q)] = residual;
        comparison.step[index_of(q)] = std::min(comparison.step[index_of(q)], step);
    };
    lessen(Quantity::speed, (mine.speed - oblique->speed) / reference, oblique->speed_step / reference);
    lessen(Quantity::acceleration, (mine.acceleration - oblique->acceleration).norm(), oblique->acceleration_step);
    if (oblique->corner) lessen(Quantity::relief, mine.relief - oblique->relief, oblique->relief_step);
}

Comparison Comparer::compare(const PathLocation& here, int aside) const {
    return compare_with(Peers::all, here, aside);
}

std::array<float, quantities> Comparer::change_nearby(PointIndex point, float reference) const {
    std::array<float, quantities> change{};
    const Positions& p = surface_.positions;
    const Sample& mine = signals_[point];
    const auto widen = [&](Quantity q, float value) { change[index_of(q)] = larger(change[index_of(q)], value); };
    for (const PointIndex direction : {-1, 1}) {
        for (PointIndex i = point + direction; i >= 0 && i < p.size() && signals_[i].zone != Zone::outside;
             i += direction) {
            const Sample& there = signals_[i];
            widen(Quantity::speed, std::abs(there.speed - mine.speed) / reference);
            widen(Quantity::normal_deviation, std::abs(there.normal_deviation - mine.normal_deviation));
            widen(Quantity::relief, std::abs(there.relief - mine.relief));
            widen(Quantity::acceleration, (signals_.acceleration(i) - signals_.acceleration(point)).norm());
            if (!((p[i] - p[point]).norm() < slack_step_overs * static_cast<float>(surface_.step_over))) break;
        }
    }
    return change;
}

Comparison Comparer::compare_at_end(const PathLocation& here) const {
    const PointIndex point = here.nearest();
    Comparison result = compare_with(Peers::same_direction, here, passes_aside);
    const float reference = std::max(signals_[point].speed, least_speed_);
    result.slack = change_nearby(point, reference);
    // A change that the other passes do not have does not count as slack.
    std::array<float, quantities> others{};
    for (const Side side : {Side::left, Side::right}) {
        for_each_judged_neighbour(
            surface_, signals_, here, side, passes_aside, along_or_against, [&](const PathLocation& at, int) {
                if (runs_against(signals_, point, at)) return;
                const std::array<float, quantities> there = change_nearby(at.nearest(), reference);
                for (std::size_t q = 0; q < quantities; ++q) others[q] = std::max(others[q], there[q]);
            });
    }
    for (std::size_t q = 0; q < quantities; ++q) result.slack[q] = std::min(result.slack[q], others[q]);
    return result;
}

namespace {

/// Adds the step to the adjacent pass of one side; NaN: not known.
void add_step(Comparison& comparison, Quantity q, float difference) {
    float& step = comparison.step[index_of(q)];
    float& lesser = comparison.lesser_step[index_of(q)];
    lesser = step == step ? std::min(step, difference) : difference;
    step = larger(step, difference);
}

}  // namespace

Comparison Comparer::compare_with(Peers peers, const PathLocation& here, int aside) const {
    Comparison result;
    result.step.fill(missing<float>);
    result.residual.fill(missing<float>);
    const PointIndex point = here.nearest();
    const Eigen::Vector3f normal = signals_.normal(point);
    const Compared mine = compared_at(signals_, here, normal);
    result.ramp = signals_[point].zone == Zone::ramp;

    SurroundingPasses others;
    auto& count = others.count;
    const auto collect = [&](Side side, int most) {
        const auto s = static_cast<std::size_t>(side);
        bool against = false;  // as in a zigzag: the next pass with this direction is the second one
        count[s] = 0;
        PathLocation& adjacent_place = side == Side::left ? result.adjacent_left : result.adjacent_right;
        adjacent_place = for_each_judged_neighbour(
            surface_, signals_, here, side, most, along_or_against, [&](const PathLocation& at, int passes) {
                if (passes == 1) against = runs_against(signals_, point, at);
                if ((passes == 1 || (passes == 2 && against)) && signals_[at.nearest()].zone == Zone::ramp)
                    result.ramp = true;
                if (peers == Peers::same_direction && runs_against(signals_, point, at)) return;
                others.of[s][static_cast<std::size_t>(count[s]++)] = compared_at(signals_, at, normal);
            });
    };
    constexpr std::array sides{Side::left, Side::right};
    for (const Side side : sides) collect(side, aside);
    // Near a border one side has few passes: more passes of the other side outvote a fault or a band of them.
    if (aside == passes_aside && peers == Peers::all) {
        const std::array<int, 2> near_ones = count;
        for (std::size_t s = 0; s < 2; ++s) {
            if (near_ones[s] == aside && near_ones[1 - s] < aside)
                collect(sides[s], passes_around_border - near_ones[1 - s]);
        }
    }
    for (std::size_t s = 0; s < 2; ++s) {
        if (count[s] == 0) continue;
        const Compared& adjacent = others.of[s][0];
        const Compared next = count[s] > 1 ? others.of[s][1] : no_pass();
        add_step(result, Quantity::speed, step_beyond_trend(mine.speed, adjacent.speed, next.speed));
        add_step(result, Quantity::acceleration,
                 step_beyond_trend(mine.acceleration, adjacent.acceleration, next.acceleration));
        add_step(result, Quantity::normal_deviation,
                 step_beyond_trend(mine.normal_deviation, adjacent.normal_deviation, next.normal_deviation));
        add_step(result, Quantity::relief, step_beyond_trend(mine.relief, adjacent.relief, next.relief));
    }
    result.left = others.count[0];
    result.right = others.count[1];
    const float reference = fill_residuals(mine, others, least_speed_, result);
    result.step[index_of(Quantity::speed)] /= reference;
    result.lesser_step[index_of(Quantity::speed)] /= reference;
    result.uncertainty[index_of(Quantity::speed)] = change_of_two_periods(signals_, &Sample::speed, point) / reference;
    if (signals_.measured)
        result.uncertainty[index_of(Quantity::normal_deviation)] =
            change_of_two_periods(signals_, &Sample::normal_deviation, point);
    return result;
}

Thresholds measure_thresholds(const ClSurface& surface, const Signals& signals, const ThresholdRule& rule,
                              const std::function<void()>& forget) {
    Thresholds thresholds;
    const PointIndex count = signals.size();
    const std::vector<PointIndex> points = sample_judged(signals, forget);
    std::vector<std::array<float, 2>> motion(points.size());
    for_each_sample(points, count, forget, [&](std::size_t k) {
        const Sample& sample = signals.motion_of(points[k]);
        motion[k] = {sample.speed, vector_of(sample.acceleration).norm()};
    });
    std::vector<float> values = known(points.size(), [&](std::size_t k) { return motion[k][0]; });
    thresholds.usual_speed = quantile(values, 0.95);
    values = known(points.size(), [&](std::size_t k) { return motion[k][1]; });
    thresholds.usual_acceleration = quantile(values, 0.99);

    const float least_speed_step = larger(rule.speed, signals.speed_noise / thresholds.usual_speed);
    const std::array<float, quantities> least{
        least_speed_step,
        // A change of speed below its threshold is no defect by its acceleration either, however sharp the change and however
        // clean the log.
        std::max({rule.acceleration * thresholds.usual_acceleration, signals.acceleration_noise,
                  least_speed_step * thresholds.usual_speed * signals.speed_step_response}),
        std::max(rule.height, rule.normal_deviation_quanta * signals.quantum),
        std::max(rule.height, rule.relief_quanta * signals.quantum)};
    thresholds.least_speed =
        std::max(rule.least_speed * thresholds.usual_speed, signals.speed_noise / least[index_of(Quantity::speed)]);

    const Comparer comparer(surface, signals, thresholds.least_speed);
    std::vector<std::array<float, quantities>> steps(points.size());
    for_each_sample(points, count, forget, [&](std::size_t k) { steps[k] = comparer.compare({points[k], 0}, 1).step; });
    for (std::size_t q = 0; q < quantities; ++q) {
        values = known(points.size(), [&](std::size_t k) { return steps[k][q]; });
        thresholds.p99[q] = quantile(values, 0.99);
        const float median = quantile(values, 0.5);
        for (float& v : values) v = std::abs(v - median);
        const float spread = static_cast<float>(deviation_of_mad) * quantile(values, 0.5);
        thresholds.median[q] = median;
        thresholds.spread[q] = spread;
        const float own =
            median + (q == index_of(Quantity::acceleration) ? rule.acceleration_spreads : rule.spreads) * spread;
        // Facets of the program are texture if they are everywhere, whatever their height: no upper limit.
        const float most =
            q == index_of(Quantity::relief) ? std::numeric_limits<float>::infinity() : rule.most * least[q];
        thresholds.of[q] = own == own ? std::max(least[q], std::min(own, most)) : least[q];
    }
    return thresholds;
}

}  // namespace clsurf
