#pragma once
// Feeds for the points of a proposal: feeds that synchronise adjacent passes, and feeds that remove the
// remaining defects, as far as the time budget allows.

#include <vector>

#include "machine/machine.h"
#include "repair/feeds/feed_reduction.h"
#include "repair/feeds/ramp.h"
#include "repair/proposal.h"

namespace clsurf {

/// The state of a feed reduction over several rounds.
struct FeedReduction {
    // Speeds are equalised to this share of the threshold (docs/experiments/repair.md#the-search-in-detail, step 1).
    static constexpr double usual_step = 0.7;
    TriedProposal from;             ///< the last one kept
    double share = 0;               ///< share of the available time that the next round may use
    double step = usual_step;       ///< step of the speed around defects that is accepted, in thresholds
    std::vector<Vec3> abandoned{};  ///< [mm] places of defects that are no longer repaired
};

class FeedSearch {
public:
    /// The evaluator must outlive it.
    FeedSearch(Evaluator& evaluator, const Machine& machine);

    /// Feeds that make adjacent passes equal everywhere within a step [mm/s]: the smallest step for which the time that `from`
    /// has saved is sufficient.
    void equalise_in_time(const TriedProposal& from);

    /// The same with steps that are fixed fractions of the speed.
    void equalise(const TriedProposal& from);

    /// Slows down around remaining defects, in rounds, until the time budget is used up. Each round tries several variants: one
    /// feed reduction; the same only for the defects that it removed; the last of these with the feeds raised to what its
    /// speeds need; two with gentle ramps; and a combination of the variants that ran best at each place.
    void reduce_feeds(FeedReduction& reduction, int rounds);

private:
    /// Adds attempts that combine these attempts and `from`: each motion gets the target that ran best around it.
    void mix(const TriedProposal& from, std::vector<TriedProposal>& attempts);

    Evaluator& evaluator_;
    double lag_power_;
    Ramp ramp_;
};

}  // namespace clsurf
