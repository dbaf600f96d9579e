#pragma once
// Residuals: the value of a pass, less the value that the passes beside it predict. Near the border of a part or an island, and
// near a step in the outline, one side has few passes or none.

#include <span>

namespace clsurf {

/// Passes that a place is compared with in all where one side has fewer than the usual number: an odd number, so that
/// passes that alternate do not balance.
inline constexpr int passes_around_border = 9;

/// The value that a pass should have by those of the passes on its two sides, the adjacent one first; NaN: unknown.
///
/// With equally many on both sides it is their median: what changes evenly from pass to pass drops out. Otherwise it is the median
/// of the values less an even change from pass to pass. That change is the one nearest to 0 between the quartiles of the
/// changes from each pass to the next: a faulty pass or a band of them alters two of these changes, an even change all of them.
/// Where the passes do not change evenly, such as the speeds towards the middle of a spiral, a difference from the median is none up to
/// `clear_of_scatter` times the median of their own distances from it.
/// Of two passes it is the value between them that is nearest to `own`: they cannot tell a change from a fault of one of
/// them. NaN of fewer than two. Domain: at most passes_around_border values, or ten that are equally many on both sides.
[[nodiscard]] float usual_beside(float own, std::span<const float> left, std::span<const float> right,
                                 float clear_of_scatter = 0);

/// How much of a relief is a mark of the pass itself: it lies above what the passes beside it have (+), or below (−). 0 where
/// it is the part's own shape or the effect of an adjacent pass that lies off; NaN: unknown. `left`, `right`: the
/// reliefs of the passes on both sides, the adjacent one first. Outermost passes have none (NaN).
[[nodiscard]] float relief_mark(float own, std::span<const float> left, std::span<const float> right);

}  // namespace clsurf
