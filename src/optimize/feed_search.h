#pragma once
// Feeds for the points of a proposal: such as bring neighbour passes into step, and such as cure the defects that are left, as far as there
// is time for.

#include <vector>

#include "machine/machine.h"
#include "optimize/cure.h"
#include "optimize/proposal.h"
#include "optimize/ramp.h"

namespace clsurf {

/// A cure that goes on: where it has come to.
struct Curing {
    static constexpr double usual_step = 0.7;
    Tried from;                    ///< the last one kept
    double share = 0;              ///< of the time there is to lose, that the next round may take
    double step = usual_step;      ///< of the threshold of a speed step, that is left about defects
    std::vector<Vec3> hopeless{};  ///< [mm] places of defects that are let be
};

class FeedSearch {
public:
    /// The prover must outlive it.
    FeedSearch(Prover& prover, const Machine& machine);

    /// Feeds that bring neighbour passes within a step [mm/s] of each other everywhere: as small a one as the time that `from` saves pays for.
    void level_in_time(const Tried& from);

    /// The same with steps that are fixed shares of the speed.
    void level(const Tried& from);

    /// Round by round slower where defects are left, as long as there is time to lose. Each round is a cure, the same for the
    /// defects alone that it helped, and the last of them with feeds as high as its speeds need.
    void cure(Curing& curing, int rounds);

private:
    Prover& prover_;
    double lag_power_;
    Ramp ramp_;
};

}  // namespace clsurf
