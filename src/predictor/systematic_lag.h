#pragma once
// Systematic lag: a normal deviation that alternates with the direction of travel. In a zigzag, axes with different servo gains
// leave the path to one side on forward passes and to the other side on backward passes. Every pass then differs from both
// neighbours over a large part of the surface. This is one finding about the machine, not one about each place.
//
// The alternating component at a place is the median lag of the passes with its own direction minus that of the other
// direction, over eight passes on each side, without the place itself. Where it is systematic, the lag of a place is compared
// only with passes of its own direction, so a local fault inside the region remains a separate finding.

#include <vector>

#include "predictor/candidates.h"
#include "predictor/mismatch.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// A place where the lag alternates.
struct AlternatingSite {
    PointIndex point = 0;
    std::size_t pass = 0;  ///< index into surface.passes
    float step = 0;        ///< [mm] change of the lag from the other direction to its own; signed as the lag
};

struct SystematicLag {
    std::vector<AlternatingSite>
        sites;  ///< sites whose step exceeds the threshold, in the order of their points; empty: none
};

/// Finds where the lag of `found` alternates over a large part of the surface, and subtracts the alternating component from the
/// candidates there: their lag shares, scores and residuals are then relative to the passes of the same direction. `along`:
/// joined_along(). O(candidates log candidates), parallel; the same for any number of threads. `forget`: called between
/// portions of them.
[[nodiscard]] SystematicLag take_systematic_lag(const ClSurface& surface, const Signals& signals,
                                                const ArcLength& arc_length, const Thresholds& thresholds, double along,
                                                FoundCandidates& found, const ForgetBlocks& forget = {});

}  // namespace clsurf
