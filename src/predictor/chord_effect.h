#pragma once
// Chord effect: how a displaced pass changes the relief of the adjacent passes.
//
// The relief of a point is its height above the chord between the adjacent passes. A pass that is too high by h therefore gives
// each adjacent pass a relief of −h/2. residual.h removes this if the reliefs of three passes sum to zero. They do not if the
// tool is slower on one of them: heights are means over time, so a peak is narrower where the tool is slow.

#include "core/block_fill.h"
#include "predictor/candidates.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// Removes the relief of the candidates that a stronger relief on an adjacent pass explains: share, score and residual become
/// 0. The adjacent pass has an opposite relief, and the relief of this pass is at most 0.6 times as large; for both, the
/// largest within `along` mm of the place counts. A pass that is itself displaced to the opposite side by more than 0.15 of the
/// adjacent pass keeps its relief. O(candidates log candidates + candidates · those within `along`). `forget`: called between
/// portions of them.
void take_chord_effects(const Passes& passes, const ArcLength& arc_length, double along, FoundCandidates& found,
                        const ForgetBlocks& forget = {});

}  // namespace clsurf
