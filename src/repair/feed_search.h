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
    static constexpr double usual_step = 0.7;
    TriedProposal from;             ///< the last one kept
    double share = 0;               ///< of the time there is to lose, that the next round may take
    double step = usual_step;       ///< of the threshold of a speed step, that is left about defects
    std::vector<Vec3> abandoned{};  ///< [mm] places of defects that are let be
};

class FeedSearch {
public:
    /// The evaluator must outlive it.
    FeedSearch(Evaluator& evaluator, const Machine& machine);

    /// Feeds that make adjacent passes equal everywhere within a step [mm/s], the smallest one that the time saved by
    /// `from` allows.
    void equalise_in_time(const TriedProposal& from);

    /// The same with steps that are fixed fractions of the speed.
    void equalise(const TriedProposal& from);

    /// Slows down around remaining defects, round by round, as long as the time budget lasts. Each round is one feed
    /// reduction, the same only for the defects that it removed, the last of these with feeds as high as its speeds
    /// need, and for each place what ran best there.
    void reduce_feeds(FeedReduction& reduction, int rounds);

private:
    /// Adds attempts that have for each motion the target that ran best about it, of these attempts and of `from`.
    void mix(const TriedProposal& from, std::vector<TriedProposal>& attempts);

    Evaluator& evaluator_;
    double lag_power_;
    Ramp ramp_;
};

}  // namespace clsurf
