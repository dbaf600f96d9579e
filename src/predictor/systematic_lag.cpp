#include "predictor/systematic_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "core/block_portions.h"
#include "core/not_finite.h"
#include "core/parallel.h"
#include "predictor/judged_neighbours.h"
#include "predictor/median_of.h"

namespace clsurf {
namespace {

// lag_passes_aside, fewest_passes, least_share, shift_step_overs: docs/design/predictor.md#5-separate-systematic-lag.
constexpr int lag_passes_aside = 8;     ///< passes compared per side; narrower faults on every second one do not count
constexpr float one_sided_bend = 1.5F;  ///< extrapolation from the two rings of passes on one side to the place
constexpr float alternates = 0.5F;      ///< share of the threshold
constexpr std::size_t fewest_of_a_kind = 2;  ///< fewest passes of each direction for a median
constexpr std::size_t fewest_passes = 8;     ///< fewest passes that a region spans
constexpr double least_share = 0.05;         ///< least share of the path of all cut passes that is systematic
constexpr float shift_step_overs =
    2;  ///< step-overs along the feed: next to an edge at 45°, the next pass of its direction changes so much later

/// The lag of a place among the passes around it.
struct LagAround {
    float alternating = missing<float>;  ///< [mm] own direction minus the other one, without the place itself
    float residual = missing<float>;     ///< [mm] to the median of its own direction
    float step = missing<float>;         ///< [mm] ≥ 0, to the next passes of its own direction
    float slack = 0;                     ///< [mm] of residual and step: change that all passes have nearby
};

class LagComparer {
public:
    LagComparer(const ClSurface& surface, const Signals& signals) : surface_(surface), signals_(signals) {}

    [[nodiscard]] LagAround around(const PathLocation& here) const {
        const PointIndex point = here.nearest();
        const Eigen::Vector3f normal = signals_.normal(point);
        std::array<Directions, 2> sides;
        float slack_of_others = 0;
        for (const Side side : {Side::left, Side::right}) {
            Directions& mine = sides[static_cast<std::size_t>(side)];
            const auto read = [&](const PathLocation& at, int) {
                const float lag = compared_at(signals_, at, normal).normal_deviation;
                if (!(lag == lag)) return;
                const bool against = signals_.feed(at.nearest()).dot(signals_.feed(point)) < 0;
                (against ? mine.other : mine.own).add(lag);
                if (!against) slack_of_others = std::max(slack_of_others, change_nearby(at.nearest()));
            };
            for_each_judged_neighbour(surface_, signals_, here, side, lag_passes_aside, along_or_against, read);
        }
        const float lag = compared_at(signals_, here, normal).normal_deviation;
        const float usual = balanced_median(sides[0].own, sides[1].own);
        const float bend = bend_across(sides[0].own, sides[1].own);
        LagAround result;
        result.alternating = usual - balanced_median(sides[0].other, sides[1].other);
        result.residual = lag - usual;
        for (const Directions& side : sides) {
            if (side.own.count == 0) continue;
            const float step = std::abs(lag - side.own.values[0]);
            if (!(result.step >= step)) result.step = step;
        }
        result.slack = std::max(std::min(change_nearby(point), slack_of_others), bend);
        return result;
    }

private:
    /// Lags of passes, the nearest first.
    struct Lags {
        std::array<float, lag_passes_aside> values{};
        std::size_t count = 0;
        void add(float lag) { values[count++] = lag; }
    };
    struct Directions {
        Lags own, other;
    };

    /// Median of equal numbers of passes on both sides, so that an even change from pass to pass cancels; of all passes of one
    /// side if the other has none.
    [[nodiscard]] static float balanced_median(const Lags& left, const Lags& right) {
        std::array<float, lag_passes_aside> all{};
        const std::size_t even = std::min({left.count, right.count, all.size() / 2});
        std::size_t n = 0;
        for (const Lags* side : {&left, &right}) {
            const std::size_t count = even > 0 ? even : side->count;
            for (std::size_t k = 0; k < count; ++k) all[n++] = side->values[k];
        }
        return median_of(std::span<const float>(all.data(), n), fewest_of_a_kind, [](float v) { return v; });
    }

    /// Change of the lag of one direction from the nearer to the farther passes: a place may differ from all of them by as
    /// much. 0 if it is not known.
    [[nodiscard]] static float bend_across(const Lags& left, const Lags& right) {
        constexpr std::size_t near = lag_passes_aside / 4;
        const auto ring = [&](std::size_t first, std::size_t last) {
            std::array<float, lag_passes_aside> values{};
            std::size_t n = 0;
            for (const Lags* side : {&left, &right}) {
                for (std::size_t k = first; k < std::min(last, side->count); ++k) values[n++] = side->values[k];
            }
            return median_of(std::span<const float>(values.data(), n), 1, [](float v) { return v; });
        };
        const bool one_sided = left.count == 0 || right.count == 0;
        const float bend = std::abs(ring(0, near) - ring(near, 2 * near)) * (one_sided ? one_sided_bend : 1);
        return bend == bend ? bend : 0;
    }

    /// Largest change of the lag along its pass within `shift_step_overs`.
    [[nodiscard]] float change_nearby(PointIndex point) const {
        const Positions& p = surface_.positions;
        float change = 0;
        for (const PointIndex direction : {-1, 1}) {
            for (PointIndex i = point + direction; i >= 0 && i < p.size() && signals_[i].zone != Zone::outside;
                 i += direction) {
                change = std::max(change, std::abs(signals_[i].normal_deviation - signals_[point].normal_deviation));
                if (!((p[i] - p[point]).norm() < shift_step_overs * static_cast<float>(surface_.step_over))) break;
            }
        }
        return change;
    }

    const ClSurface& surface_;
    const Signals& signals_;
};

/// A candidate around which the lag alternates, or where this is not known because too few of the passes run on.
struct Candidate {
    DefectCandidate* defect_candidate = nullptr;
    LagAround lag;
    [[nodiscard]] bool known() const { return lag.alternating == lag.alternating; }
};

/// The candidates of `found` around which the lag alternates, in the order of their points.
std::vector<Candidate> find_candidates(const LagComparer& comparer, const Thresholds& thresholds,
                                       FoundCandidates& found, const ForgetBlocks& forget) {
    std::vector<Candidate> all;
    for (DefectCandidate* defect_candidate : found.with_share_of(Quantity::normal_deviation))
        all.push_back({defect_candidate, {}});
    // A size of portions for threads; results do not depend on it.
    constexpr std::int64_t grain = 1024;
    for_each_portion(
        all.size(), forget, [&](std::size_t k) { return all[k].defect_candidate->point; },
        [&](std::size_t begin, std::size_t end) {
            parallel_for(static_cast<std::int64_t>(end - begin), grain, [&](std::int64_t first, std::int64_t last) {
                for (std::size_t k = begin + static_cast<std::size_t>(first);
                     k < begin + static_cast<std::size_t>(last); ++k)
                    all[k].lag = comparer.around({all[k].defect_candidate->point, 0});
            });
        });
    std::erase_if(all, [&](const Candidate& c) {
        return std::abs(c.lag.alternating) < alternates * thresholds.of[index_of(Quantity::normal_deviation)];
    });
    return all;
}

/// Arc length between consecutive sites of one pass [mm].
double arc_length_of(std::span<const AlternatingSite> sites, const ArcLength& arc_length, double joined) {
    double sum = 0;
    for (std::size_t k = 1; k < sites.size(); ++k) {
        if (sites[k].pass == sites[k - 1].pass && !arc_length.at_least(sites[k - 1].point, sites[k].point, joined))
            sum += arc_length.to(sites[k].point) - arc_length.to(sites[k - 1].point);
    }
    return sum;
}

/// Whether places, in the order of their points, spread over so many passes that not a few of them are the cause.
bool is_wide(std::span<const std::size_t> region, const std::vector<Candidate>& candidates) {
    std::size_t passes = 0;
    const DefectCandidate* before = nullptr;
    for (const std::size_t k : region) {
        if (!candidates[k].known()) continue;
        const DefectCandidate* here = candidates[k].defect_candidate;
        passes += before == nullptr || here->pass != before->pass ? 1 : 0;
        before = here;
    }
    return passes >= fewest_passes;
}

/// Replaces the lag difference of a candidate by the one to the passes of its own direction; 0 if that is not known.
void subtract(const Candidate& candidate, const Thresholds& thresholds) {
    constexpr std::size_t q = index_of(Quantity::normal_deviation);
    DefectCandidate& s = *candidate.defect_candidate;
    const LagAround& lag = candidate.lag;
    const float left = candidate.known() ? std::max(std::abs(lag.residual) - lag.slack, 0.0F) : 0;
    const float step = candidate.known() ? std::max(lag.step - lag.slack, 0.0F) : 0;
    s.comparison.residual[q] = std::copysign(left, lag.residual);
    s.comparison.step[q] = step;
    s.comparison.slack[q] = 0;
    s.share[q] = left / thresholds.of[q];
    s.score[q] = std::max(0.0F, std::min((step - s.comparison.uncertainty[q]) / thresholds.of[q], 2 * s.share[q]));
}

}  // namespace

SystematicLag take_systematic_lag(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
                                  const Thresholds& thresholds, double along, FoundCandidates& found,
                                  const ForgetBlocks& forget) {
    SystematicLag result;
    if (!signals.measured) return result;
    const std::vector<Candidate> candidates = find_candidates(LagComparer(surface, signals), thresholds, found, forget);
    DefectCandidates defect_candidates;
    for (const Candidate& candidate : candidates) defect_candidates.push_back(candidate.defect_candidate);
    std::vector<std::size_t> wide;  // candidates of wide regions
    for (const DefectCandidates& region : group_candidates(defect_candidates, surface, arc_length, along, forget)) {
        std::vector<std::size_t> members;
        for (const DefectCandidate* s : region) members.push_back(index_by_point(defect_candidates, s->point));
        if (is_wide(members, candidates)) wide.insert(wide.end(), members.begin(), members.end());
    }
    std::sort(wide.begin(), wide.end());
    const float threshold = thresholds.of[index_of(Quantity::normal_deviation)];
    for (const std::size_t k : wide) {
        const Candidate& c = candidates[k];
        if (std::abs(c.lag.alternating) >= threshold)
            result.sites.push_back({c.defect_candidate->point, c.defect_candidate->pass, c.lag.alternating});
    }
    if (arc_length_of(result.sites, arc_length, along) < least_share * cut_arc_length(surface, arc_length)) {
        result.sites.clear();
        return result;
    }
    for (const std::size_t k : wide) subtract(candidates[k], thresholds);
    return result;
}

}  // namespace clsurf
