#include "predictor/border.h"

#include <algorithm>
#include <vector>

#include "predictor/defect_core.h"

namespace clsurf {
namespace {

// clear_score, passes_enough, flank_ramps: docs/design/predictor.md#4-join-places-into-defects, Expected.
constexpr float clear_score = 2;
constexpr int passes_enough = 3;  ///< number of passes on the side that has some
constexpr std::size_t sites_enough = 3;
constexpr float steady_share = 0.1F;  ///< share of the usual acceleration along the path: below it, the speed is steady
constexpr double flank_seconds = 0.020;  ///< a height may last so much longer than the motion that causes it
// The rule for heights in docs/design/predictor.md#4-join-places-into-defects, Expected.
constexpr float falls_to =
    0.7F;  ///< share of the height at the border: a flank must be lower, except for the sites next to the border
constexpr double flank_ramps = 1.5;  ///< jerk makes ramps longer than the acceleration alone

}  // namespace

Border::Border(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
               const DefectCandidates& candidates, double along, const Thresholds& thresholds)
    : surface_(surface), signals_(signals), arc_length_(arc_length), along_(along), thresholds_(thresholds) {
    for (const DefectCandidate* s : candidates) {
        if (s->border || s->bend) at_border_.push_back(s);
    }
}

const DefectCandidate* Border::find_as_strong(PointIndex point, std::size_t pass, float share,
                                              Quantity quantity) const {
    const auto strong = [&](const DefectCandidate* s) {
        return s->pass == pass && s->expected(quantity) && s->share[index_of(quantity)] >= share;
    };
    const CandidateSpan near = candidates_near(at_border_, point, arc_length_, along_);  // few
    const std::size_t after = index_by_point(near, point);
    const auto behind = std::find_if(near.begin() + static_cast<std::ptrdiff_t>(after), near.end(), strong);
    if (behind != near.end()) return *behind;
    const auto before = std::find_if(near.rend() - static_cast<std::ptrdiff_t>(after), near.rend(), strong);
    return before == near.rend() ? nullptr : *before;
}

const DefectCandidate* Border::flank_of(const DefectCandidates& core, Quantity quantity) const {
    const std::size_t q = index_of(quantity);
    const auto weaker = [q](const DefectCandidate* a, const DefectCandidate* b) { return a->share[q] < b->share[q]; };
    const auto strongest = std::max_element(core.begin(), core.end(), weaker);
    const float peak = (*strongest)->share[q];
    const auto hangs = [&](const DefectCandidate* a, const DefectCandidate* b) {
        return a->pass == b->pass && !arc_length_.at_least(a->point, b->point, along_);
    };
    auto first = strongest, last = strongest;
    while (first != core.begin() && hangs(*(first - 1), *first)) --first;
    while (last + 1 != core.end() && hangs(*last, *(last + 1))) ++last;
    const std::size_t pass = (*strongest)->pass;
    for (const DefectCandidate* end : {*first, *last}) {
        if (const DefectCandidate* at = find_as_strong(end->point, pass, peak, quantity)) return at;
    }
    const Comparison& c = (*strongest)->comparison;
    for (const PathLocation& at : {c.adjacent_left, c.adjacent_right}) {
        if (!at.exists()) continue;
        const std::size_t beside = pass_of(surface_.passes, at.nearest());
        if (const DefectCandidate* near = find_as_strong(at.nearest(), beside, peak, quantity)) return near;
    }
    return nullptr;
}

double Border::flank_reach(const DefectCandidates& core, Quantity quantity) const {
    double ramp = thresholds_.usual_speed * flank_seconds;
    if (quantity == Quantity::speed || quantity == Quantity::acceleration) {
        float jump = 0;
        for (const DefectCandidate* s : core) jump = std::max(jump, std::abs(s->comparison.speed_jump));
        if (thresholds_.usual_acceleration > 0)
            ramp = std::max<double>(ramp, thresholds_.usual_speed * jump / thresholds_.usual_acceleration);
    }
    return 2 * along_ + flank_ramps * ramp;
}

bool Border::ramps(PointIndex point) const {
    const float along = signals_.acceleration(point).dot(signals_.feed(point));
    return !(std::abs(along) < steady_share * thresholds_.usual_acceleration);
}

bool Border::on_flank(const DefectCandidate& site, const DefectCandidate& at, double reach, Quantity quantity) const {
    const double distance = (surface_.positions[site.point] - surface_.positions[at.point]).norm();
    if (distance >= reach) return false;
    if (distance < along_) return true;
    const std::size_t q = index_of(quantity);
    if (quantity == Quantity::normal_deviation || quantity == Quantity::relief)
        return site.share[q] < falls_to * at.share[q];
    if (quantity != Quantity::speed || ramps(site.point)) return true;
    const Comparison& c = site.comparison;
    return (c.adjacent_left.exists() && ramps(c.adjacent_left.nearest())) ||
           (c.adjacent_right.exists() && ramps(c.adjacent_right.nearest()));
}

bool Border::goes_on(PointIndex point, int direction) const {
    for (PointIndex i = point; i >= 0 && i < signals_.size(); i += direction) {
        if (signals_[i].zone == Zone::outside) return false;
        if (arc_length_.at_least(std::min(i, point), std::max(i, point), along_)) return true;
    }
    return false;
}

bool Border::stands_out(const DefectCandidates& core, Quantity quantity) const {
    const std::size_t q = index_of(quantity);
    const auto clear = [&](const DefectCandidate* s) {
        const Comparison& c = s->comparison;
        if (s->turns || s->bends(quantity) || std::min(s->score[q], s->share[q]) < clear_score) return false;
        if (!s->border) return true;
        if (c.left == 0 || c.right == 0) return std::max(c.left, c.right) >= passes_enough;
        return quantity == Quantity::speed && c.residual[q] < 0 && signals_[s->point].zone != Zone::ramp;
    };
    const std::vector<CandidateSpan> runs = runs_of(core, arc_length_, along_);
    return std::any_of(runs.begin(), runs.end(), [&](CandidateSpan run) {
        return static_cast<std::size_t>(std::count_if(run.begin(), run.end(), clear)) >= sites_enough &&
               goes_on(run.front()->point, -1) && goes_on(run.back()->point, +1);
    });
}

}  // namespace clsurf
