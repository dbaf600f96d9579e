#include "predictor/candidates.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/block.h"
#include "core/block_portions.h"
#include "core/point_ranges.h"
#include "predictor/bend.h"
#include "predictor/oblique_alignment.h"
#include "predictor/sites.h"

namespace clsurf {
namespace {

// fewest_alike, candidate_share: docs/design/predictor.md#4-join-places-into-defects.
constexpr int fewest_alike = 2;          ///< passes of one direction on each side, to distinguish a zigzag from a fault
constexpr float candidate_share = 0.5F;  ///< share of a threshold
constexpr double ends_apart = 1;         ///< step-overs along the feed: closer ends of passes are side by side
constexpr double ramp_room = 1.5;        ///< times the change of speed of the steeper ramp over that distance
constexpr float join_reach = 1.0F;  ///< step-overs along the feed: largest distance between candidates of two passes

/// Sets share and score of a candidate.
void measure(DefectCandidate& candidate, const Thresholds& thresholds) {
    candidate.share.fill(0);
    candidate.score.fill(0);
    for (std::size_t q = 0; q < quantities; ++q) {
        const Comparison& c = candidate.comparison;
        const float share =
            std::max(std::abs(c.residual[q]) - c.slack[q], 0.0F) / thresholds.of[q];  // NaN stays NaN in this order
        if (!(share == share)) continue;
        candidate.share[q] = share;
        const float step = (c.step[q] - c.uncertainty[q] - c.slack[q]) / thresholds.of[q];
        candidate.score[q] = step == step ? std::min(step, 2 * share) : 0;
    }
}

/// Disjoint sets of candidates, joined by any number of threads. Roots are attached to lower roots only, so the result does not
/// depend on the order of joins.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) {
        for (std::size_t i = 0; i < count; ++i) parent_[i].store(i, std::memory_order_relaxed);
    }
    /// The lowest index of a set.
    std::size_t root(std::size_t i) {
        for (;;) {
            std::size_t parent = parent_[i].load(std::memory_order_relaxed);
            if (parent == i) return i;
            const std::size_t above = parent_[parent].load(std::memory_order_relaxed);
            if (above != parent) parent_[i].compare_exchange_weak(parent, above, std::memory_order_relaxed);
            i = above;
        }
    }
    void join(std::size_t a, std::size_t b) {
        for (;;) {
            a = root(a);
            b = root(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            std::size_t still_root = a;
            if (parent_[a].compare_exchange_strong(still_root, b, std::memory_order_relaxed)) return;
        }
    }

private:
    std::vector<std::atomic<std::size_t>> parent_;
};

/// Index of the first one of `points` (ascending) that is not below `point`. The search starts at `hint` and doubles its steps,
/// because consecutive queries are close to each other.
std::size_t lower_bound_near(const std::vector<PointIndex>& points, std::size_t hint, PointIndex point) {
    std::size_t low = std::min(hint, points.size());
    std::size_t high = low;
    for (std::size_t step = 1; low > 0 && points[low - 1] >= point; step *= 2) {
        high = low - 1;
        low -= std::min(step, low);
    }
    for (std::size_t step = 1; high < points.size() && points[high] < point; step *= 2) {
        low = high + 1;
        high = std::min(high + step, points.size());
    }
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(low);
    return static_cast<std::size_t>(std::lower_bound(begin, points.begin() + static_cast<std::ptrdiff_t>(high), point) -
                                    points.begin());
}

}  // namespace

ComparedPoints count_compared(const ClSurface& surface, const Signals& signals, const PointRange& points) {
    std::vector<ComparedPoints> of_block(static_cast<std::size_t>((points.last + block_points) / block_points));
    for_each_block(points, [&](PointIndex first, PointIndex last) {
        ComparedPoints& mine = of_block[static_cast<std::size_t>(first / block_points)];
        for (PointIndex i = first; i < last; ++i) {
            if (signals.without_heights(i).zone == Zone::outside) continue;
            ++mine.away_from_ends;
            if (surface.neighbours.has(Side::left, i) && surface.neighbours.has(Side::right, i)) ++mine.compared;
        }
    });
    ComparedPoints all;
    for (const ComparedPoints& block : of_block) all += block;
    return all;
}

namespace {

class CandidateFinder {
public:
    CandidateFinder(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
                    const Thresholds& thresholds)
        : surface_(surface),
          signals_(signals),
          arc_length_(arc_length),
          thresholds_(thresholds),
          comparer_(surface, signals, thresholds.least_speed),
          bends_(surface, signals, thresholds),
          sites_(surface, signals),
          judged_(static_cast<std::size_t>(signals.size()), false) {}

    std::vector<PointIndex> find_starts(const PointRange& points) { return judge(sites_with_step(points)); }

    FoundCandidates find(const std::vector<PointIndex>& sites, const ForgetBlocks& forget = {}) {
        forget_ = forget;
        std::ptrdiff_t in_order = 0;  // candidates of the first portion, which are found in order
        // The sites next to candidates of a portion are examined before the next portion is read.
        in_portions(sites, [&](std::span<const PointIndex> portion) {
            std::vector<PointIndex> frontier = judge(portion);
            if (in_order == 0) in_order = static_cast<std::ptrdiff_t>(frontier.size());
            while (!frontier.empty()) frontier = judge(adjacent_of(frontier));
        });
        for (const std::vector<DefectCandidate>& piece : found_.kept) {
            for (const DefectCandidate& candidate : piece) found_.candidates.push_back(&candidate);
        }
        const auto by_point = [](const DefectCandidate* a, const DefectCandidate* b) { return a->point < b->point; };
        DefectCandidates& all = found_.candidates;
        std::sort(all.begin() + in_order, all.end(), by_point);
        std::inplace_merge(all.begin(), all.begin() + in_order, all.end(), by_point);
        return std::move(found_);
    }

    /// Sites among `points` whose step to an adjacent pass is at least half a threshold.
    [[nodiscard]] std::vector<PointIndex> sites_with_step(const PointRange& points) const {
        std::vector<std::vector<PointIndex>> of_block(
            static_cast<std::size_t>((points.last + block_points) / block_points));
        for_each_block(points, [&](PointIndex first, PointIndex last) {
            std::vector<PointIndex>& mine = of_block[static_cast<std::size_t>(first / block_points)];
            sites_.for_each(first, last, [&](PointIndex i) {
                const Comparison c = comparer_.compare(sites_.place(i), 1);
                bool steps = false;
                for (std::size_t q = 0; q < quantities; ++q)
                    steps = steps || c.step[q] >= candidate_share * thresholds_.of[q];
                if (steps) mine.push_back(i);
            });
        });
        std::vector<PointIndex> sites;
        for (const std::vector<PointIndex>& block : of_block) sites.insert(sites.end(), block.begin(), block.end());
        return sites;
    }

private:
    /// The sites next to candidates, on both sides.
    [[nodiscard]] std::vector<PointIndex> adjacent_of(const std::vector<PointIndex>& points) const {
        std::vector<PointIndex> sites;
        in_portions(points, [&](std::span<const PointIndex> portion) {
            for (const PointIndex i : portion) {
                for (const Side side : {Side::left, Side::right}) {
                    if (!surface_.neighbours.has(side, i)) continue;
                    const PointIndex site = sites_.nearest(surface_.neighbours.neighbour(side, i));
                    if (site >= 0) sites.push_back(site);
                }
            }
        });
        return sites;
    }

    /// Whether a pass and the adjacent one end at different places: one goes on, or a ramp that is farther on causes the
    /// difference.
    [[nodiscard]] bool ends_elsewhere(PointIndex point, const PathLocation& beside) const {
        const PointIndex other = beside.nearest();
        if (signals_[other].zone == Zone::inner) return true;
        const double farther = arc_length_to_end(point) - arc_length_to_end(other);
        const double faster = signals_[point].speed - signals_[other].speed;
        if (std::abs(farther) < ends_apart * surface_.step_over || !(farther * faster > 0)) return false;
        return std::abs(faster) <= ramp_room * std::abs(farther) * std::max(ramp_at(point), ramp_at(other));
    }

    /// Relative change of the speed along the pass [1/s].
    [[nodiscard]] double ramp_at(PointIndex point) const {
        const double along = signals_.acceleration(point).dot(signals_.feed(point));
        return std::abs(along) / std::max(signals_[point].speed, thresholds_.least_speed);
    }

    /// Distance [mm] to the nearer end of the judged section of the pass.
    [[nodiscard]] double arc_length_to_end(PointIndex point) const {
        const std::vector<PointRange>& pieces = signals_.pieces;
        const auto piece = range_at(pieces, point);
        if (piece == pieces.end() || piece->first > point) return 0;
        const double here = arc_length_.to(point);
        return std::min(here - arc_length_.to(piece->first), arc_length_.to(piece->last) - here);
    }

    /// Compares places where passes begin or end. A difference is expected next to a pass that goes on, and where one side has
    /// no pass. Where all passes begin or end, the two directions of a zigzag differ anyway, so a candidate must differ from
    /// passes of its own direction.
    void compare_at_end(const PathLocation& place, DefectCandidate& candidate) const {
        const Comparison& c = candidate.comparison;
        candidate.border = c.left == 0 || c.right == 0;
        if (candidate.border) return;
        if (!c.ramp) return;
        candidate.border = signals_[candidate.point].zone == Zone::inner ||
                           ends_elsewhere(candidate.point, c.adjacent_left) ||
                           ends_elsewhere(candidate.point, c.adjacent_right);
        if (candidate.border) {
            // A ramp makes its pass the slower one. If its pass is the faster one, there is another cause.
            constexpr std::size_t q = index_of(Quantity::speed);
            const bool ramps = signals_[candidate.point].zone == Zone::ramp;
            candidate.border = candidate.share[q] < candidate_share || (c.residual[q] < 0) == ramps;
            return;
        }
        const Comparison alike = comparer_.compare_at_end(place);
        candidate.border = std::min(alike.left, alike.right) < fewest_alike;
        if (candidate.border) return;
        candidate.comparison = alike;
        measure(candidate, thresholds_);
    }

    /// If one of the passes turns, the chord over it is not straight across, so the height above it is not a relief.
    void forget_relief_in_corner(DefectCandidate& candidate) const {
        constexpr std::size_t q = index_of(Quantity::relief);
        if (candidate.share[q] < candidate_share) return;
        const auto turns = [&](const PathLocation& at) {
            return at.exists() && turns_on_surface(surface_, signals_, at.nearest());
        };
        const Comparison& c = candidate.comparison;
        if (!turns({candidate.point, 0}) && !turns(c.adjacent_left) && !turns(c.adjacent_right)) return;
        candidate.comparison.residual[q] = candidate.comparison.step[q] = 0;
        candidate.share[q] = candidate.score[q] = 0;
    }

    [[nodiscard]] static bool moves_otherwise(const DefectCandidate& candidate) {
        return std::max(candidate.share[index_of(Quantity::speed)],
                        candidate.share[index_of(Quantity::acceleration)]) >= candidate_share;
    }

    /// Examines sites that were not examined before. Returns the candidates among them.
    std::vector<PointIndex> judge(std::span<const PointIndex> sites) {
        std::vector<PointIndex> fresh;
        for (const PointIndex site : sites) {
            std::vector<bool>::reference judged = judged_[static_cast<std::size_t>(site)];
            if (!judged) fresh.push_back(site);
            judged = true;
        }
        std::vector<PointIndex> found;
        in_portions(fresh, [&](std::span<const PointIndex> portion) { judge_fresh(portion, found); });
        return found;
    }

    /// Calls f(portion) for portions of points; signals are forgotten between them.
    template <typename F>
    void in_portions(const std::vector<PointIndex>& points, F&& f) const {
        for_each_portion(
            points.size(), forget_, [&](std::size_t k) { return points[k]; },
            [&](std::size_t first, std::size_t end) { f(std::span(points).subspan(first, end - first)); });
    }

    /// Examines new sites. Appends the candidates among them to `found`.
    void judge_fresh(std::span<const PointIndex> fresh, std::vector<PointIndex>& found) {
        const auto count = static_cast<std::int64_t>(fresh.size());
        const std::int64_t grain = std::clamp<std::int64_t>(count / 64, 16, 1024);
        std::vector<std::vector<DefectCandidate>> of_piece(static_cast<std::size_t>((count + grain - 1) / grain));
        parallel_for(count, grain, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                DefectCandidate candidate;
                candidate.point = fresh[static_cast<std::size_t>(k)];
                const PathLocation place = sites_.place(candidate.point);
                candidate.comparison = comparer_.compare(place);
                measure(candidate, thresholds_);
                if (*std::max_element(candidate.share.begin(), candidate.share.end()) < candidate_share) continue;
                comparer_.compare_obliquely_around(place, candidate.comparison);
                measure(candidate, thresholds_);
                if (*std::max_element(candidate.share.begin(), candidate.share.end()) < candidate_share) continue;
                forget_relief_in_corner(candidate);
                if (*std::max_element(candidate.share.begin(), candidate.share.end()) < candidate_share) continue;
                compare_at_end(place, candidate);
                candidate.turns = candidate.border && turns_on_surface(surface_, signals_, candidate.point);
                if (*std::max_element(candidate.share.begin(), candidate.share.end()) < candidate_share) continue;
                candidate.pass = pass_of(surface_.passes, candidate.point);
                candidate.bend = moves_otherwise(candidate) && bends_.explain(candidate.point, candidate.comparison);
                of_piece[static_cast<std::size_t>(first / grain)].push_back(candidate);
            }
        });
        for (std::vector<DefectCandidate>& piece : of_piece) {
            for (const DefectCandidate& candidate : piece) found.push_back(candidate.point);
            if (!piece.empty()) found_.kept.push_back(std::move(piece));
        }
    }

    const ClSurface& surface_;
    const Signals& signals_;
    const ArcLength& arc_length_;
    const Thresholds& thresholds_;
    Comparer comparer_;
    Bends bends_;
    Sites sites_;
    std::vector<bool> judged_;  ///< by point
    ForgetBlocks forget_;
    FoundCandidates found_;
};

}  // namespace

FoundCandidates find_candidates(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
                                const Thresholds& thresholds) {
    CandidateFinder finder(surface, signals, arc_length, thresholds);
    return finder.find(finder.sites_with_step({0, signals.size() - 1}));
}

std::vector<PointIndex> find_starts(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
                                    const Thresholds& thresholds, const PointRange& points) {
    return CandidateFinder(surface, signals, arc_length, thresholds).find_starts(points);
}

FoundCandidates find_candidates(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
                                const Thresholds& thresholds, const std::vector<PointIndex>& starts,
                                const ForgetBlocks& forget) {
    return CandidateFinder(surface, signals, arc_length, thresholds).find(starts, forget);
}

std::size_t index_by_point(CandidateSpan candidates, PointIndex point) {
    const auto before = [](const DefectCandidate* s, PointIndex p) { return s->point < p; };
    return static_cast<std::size_t>(std::lower_bound(candidates.begin(), candidates.end(), point, before) -
                                    candidates.begin());
}

CandidateSpan candidates_near(CandidateSpan candidates, PointIndex point, const ArcLength& arc_length, double along) {
    const std::size_t after = index_by_point(candidates, point);
    std::size_t first = after, end = after;
    while (first > 0 && !arc_length.at_least(candidates[first - 1]->point, point, along)) --first;
    while (end < candidates.size() && !arc_length.at_least(point, candidates[end]->point, along)) ++end;
    return candidates.subspan(first, end - first);
}

std::vector<DefectCandidate*> FoundCandidates::with_share_of(Quantity quantity) {
    std::vector<DefectCandidate*> found;
    for (std::vector<DefectCandidate>& piece : kept) {
        for (DefectCandidate& candidate : piece) {
            if (candidate.share[index_of(quantity)] > 0) found.push_back(&candidate);
        }
    }
    std::sort(found.begin(), found.end(),
              [](const DefectCandidate* a, const DefectCandidate* b) { return a->point < b->point; });
    return found;
}

double joined_along(const ClSurface& surface, double record) {
    constexpr double least = 1.0;  // [mm]
    // The limits of docs/design/predictor.md#4-join-places-into-defects, connected places.
    constexpr double step_overs = 2, records = 2.5;
    return std::max({least, step_overs * surface.step_over, records * record});
}

std::vector<DefectCandidates> group_candidates(const DefectCandidates& candidates, const ClSurface& surface,
                                               const ArcLength& arc_length, double along, const ForgetBlocks& forget) {
    std::vector<PointIndex> points;  // contiguous, for the search
    points.reserve(candidates.size());
    for (const DefectCandidate* s : candidates) points.push_back(s->point);
    Groups groups(candidates.size());
    const float beside = join_reach * static_cast<float>(surface.step_over);
    /// Joins a candidate with those of another pass near a point of that pass. `hint`: index of the previous result.
    const auto join_near = [&](std::size_t k, PointIndex point, std::size_t& hint) {
        const std::size_t after = hint = lower_bound_near(points, hint, point);
        const Eigen::Vector3f place = surface.positions[point];
        for (const std::size_t found : {after, after == 0 ? after : after - 1}) {
            if (found == points.size() || (surface.positions[points[found]] - place).norm() > beside) continue;
            groups.join(k, found);
        }
    };
    using Hints = std::array<std::array<std::size_t, 3>, 2>;  // per side: the adjacent pass, and the two beyond it
    const auto join = [&](std::size_t k, Hints& hints) {
        const PointIndex point = points[k];
        if (k > 0 && !arc_length.at_least(points[k - 1], point, along)) groups.join(k - 1, k);
        for (const Side side : {Side::left, Side::right}) {
            if (!surface.neighbours.has(side, point)) continue;
            const PointIndex adjacent = surface.neighbours.neighbour(side, point);
            std::array<std::size_t, 3>& near = hints[static_cast<std::size_t>(side)];
            join_near(k, adjacent, near[2]);
            // Across one clean pass.
            for (const Side other : {Side::left, Side::right}) {
                if (!surface.neighbours.has(other, adjacent)) continue;
                const PointIndex next = surface.neighbours.neighbour(other, adjacent);
                const Eigen::Vector3f on = surface.positions[next] - surface.positions[adjacent];
                if (on.dot(surface.positions[adjacent] - surface.positions[point]) > 0)
                    join_near(k, next, near[static_cast<std::size_t>(other)]);
            }
        }
    };
    // A size of portions for threads; results do not depend on it.
    constexpr std::int64_t grain = 4096;
    for_each_portion(
        points.size(), forget, [&](std::size_t k) { return points[k]; },
        [&](std::size_t begin, std::size_t end) {
            parallel_for(static_cast<std::int64_t>(end - begin), grain, [&](std::int64_t first, std::int64_t last) {
                Hints hints{};
                for (std::int64_t k = first; k < last; ++k) join(begin + static_cast<std::size_t>(k), hints);
            });
        });
    std::vector<DefectCandidates> result;
    std::vector<std::size_t> number(candidates.size());  // of the group, by its root
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const std::size_t root = groups.root(k);
        if (root == k) {
            number[k] = result.size();
            result.emplace_back();
        }
        result[number[root]].push_back(candidates[k]);
    }
    return result;
}

}  // namespace clsurf
