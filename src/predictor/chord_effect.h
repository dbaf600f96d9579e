#pragma once
// Chord effect: what a pass that lies off does to the relief of the adjacent passes.
//
// The relief of a point is its height above the chord between the adjacent passes. A pass that lies off by h therefore gives each
// adjacent pass a relief of −h/2. residual.h takes that off where the reliefs of three passes add up to nothing. Where the tool
// is slower on one of them they do not, because heights are means over time: the lower the speed, the sharper a peak is.

#include "core/block_fill.h"
#include "predictor/candidates.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// Takes the relief off those candidates whose pass has less than 0.6 of the opposite relief of an adjacent pass, both up to `along`
/// mm from the place: share, score and residual become 0. A pass that lies off by more than 0.15 of the adjacent one the other way
/// keeps its own. O(candidates log candidates + candidates · those within `along`). `forget`: called between portions of them.
void take_chord_effects(const Passes& passes, const ArcLength& arc_length, double along, FoundCandidates& found,
                        const ForgetBlocks& forget = {});

}  // namespace clsurf
