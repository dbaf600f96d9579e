#pragma once
// Residuals: the value of a pass minus the value that the surrounding passes predict. Near the border of a part or an island,
// and near a step in the outline, one side has few passes or none.

#include <span>

namespace clsurf {

/// Total number of passes that a place is compared with if one side has fewer than the usual number. It is odd, so that passes
/// that alternate do not balance. With nine, a band of up to four passes is outvoted
/// (docs/design/predictor.md#1-compare-adjacent-passes).
inline constexpr int passes_around_border = 9;

/// The value that a pass should have according to the passes on its two sides, the adjacent one first; NaN: unknown.
///
/// With equal numbers on both sides it is their median, so an even change from pass to pass cancels. Otherwise it is the median
/// of the values minus an even change from pass to pass: the change nearest to 0 between the quartiles of the changes from each
/// pass to the next. (A faulty pass or a band of them alters two of these changes, an even change alters all of them.) Passes
/// may also change unevenly, for example the speeds towards the middle of a spiral: a difference up to `clear_of_scatter` times
/// the median deviation of the passes from this value counts as zero. With two passes it is the value between theirs that is
/// nearest to `own`, because two passes cannot distinguish a change from a fault of one of them. NaN with fewer than two.
/// Domain: at most passes_around_border values, or ten with equal numbers on both sides.
[[nodiscard]] float usual_around(float own, std::span<const float> left, std::span<const float> right,
                                 float clear_of_scatter = 0);

/// The component of a relief that is a mark of the pass itself: above the surrounding passes (+), or below (−). 0 if the
/// relief is the shape of the part or the effect of a displaced adjacent pass; NaN: unknown. `left`, `right`: the reliefs
/// of the passes on both sides, the adjacent one first. Outermost passes have none (NaN).
[[nodiscard]] float relief_mark(float own, std::span<const float> left, std::span<const float> right);

}  // namespace clsurf
