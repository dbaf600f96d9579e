// The candidates of a repair as a Pareto front.

#include <algorithm>

#include <fmt/format.h>

#include "core/counted.h"

#include "repair/proposal.h"

namespace clsurf {
namespace {

constexpr std::size_t most_preferred = 8;           ///< candidates that a weight prefers are run again …
constexpr std::size_t most_preferred_of_large = 2;  ///< … if runs are large

/// "candidate 14: 231 sections and feeds"
std::string name_of(const Proposal& proposal) {
    const std::size_t sections = proposal.evaluation.intervals;
    const std::string points = sections > 0 ? clsurf::counted(sections, "section") : std::string();
    const std::string feeds = proposal.targets.empty() ? "" : points.empty() ? "feeds" : " and feeds";
    return fmt::format("candidate {}: {}{}", proposal.number, points, feeds);
}

}  // namespace

void Evaluator::keep_candidate(const Proposal& p) {
    candidates_.push_back({p.number, p.draft, p.targets, p.evaluation, p.measures(), p.summary.limits_ok,
                           row_of(name_of(p), *p.run.motion, p.run.report)});
}

std::vector<const Evaluator::Candidate*> Evaluator::accepted_candidates() const {
    std::vector<const Candidate*> accepted;
    for (const Candidate& each : candidates_) {
        // The roughness is known for finalists only, and is checked there.
        if (objection(each.evaluation, before_.measures(), each.measures, each.limits_ok).empty())
            accepted.push_back(&each);
    }
    std::ranges::stable_sort(accepted, {}, [](const Candidate* each) { return each->row.quality.duration; });
    return accepted;
}

TradeoffFront Evaluator::front_of(const std::vector<const Candidate*>& candidates) const {
    TradeoffFront front;
    front.weight = rules_.weight;
    front.rows.push_back(row_of("the program", *before_.motion, before_.report));
    for (const Candidate* each : candidates) front.rows.push_back(each->row);
    mark_front(front.rows);
    return front;
}

void Evaluator::prefer(double weight) {
    const std::vector<const Candidate*> candidates = accepted_candidates();
    const TradeoffFront front = front_of(candidates);
    const std::size_t most =
        static_cast<double>(before_.log.records) >= large_run ? most_preferred_of_large : most_preferred;
    report_progress("the candidates that the weight prefers");
    for (const std::size_t row : front_by_weight(front.rows, weight)) {
        if (row == 0) continue;  // the unchanged program
        if (preferred_.size() == most) return;
        const Candidate& candidate = *candidates[row - 1];
        preferred_.push_back(std::make_shared<Proposal>(evaluate(candidate.draft, candidate.targets)));
        preferred_.back()->number = candidate.number;
    }
}

TradeoffFront Evaluator::front(const Proposal* chosen) const {
    const std::vector<const Candidate*> candidates = accepted_candidates();
    TradeoffFront front = front_of(candidates);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (chosen != nullptr && candidates[k]->number == chosen->number) front.chosen = k + 1;
    }
    return front;
}

}  // namespace clsurf
