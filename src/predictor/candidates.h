#pragma once
// Candidates: the sites of a surface that differ from their adjacent passes, and how they are grouped.

#include <array>
#include <span>
#include <vector>

#include "predictor/mismatch.h"
#include "toolpath/arc_length.h"

namespace clsurf {

struct DefectCandidate {
    PointIndex point = 0;
    std::size_t pass = 0;  ///< index into surface.passes
    bool border = false;   ///< no pass on one side, or one begins or ends there: the difference is expected
    bool turns = false;    ///< at a border: the path turns there
    bool bend = false;     ///< a bend explains its motion (bend.h): this difference is expected
    std::array<float, quantities> share{};  ///< |residual| over threshold
    std::array<float, quantities> score{};  ///< step over threshold, at most twice `share`; a defect starts at 1
    Comparison comparison;

    [[nodiscard]] bool bends(Quantity q) const { return bend && (q == Quantity::speed || q == Quantity::acceleration); }
    /// Whether the difference of a quantity is expected there.
    [[nodiscard]] bool expected(Quantity q) const { return border || bends(q); }
};

/// Counts the ones of `points` that can be compared. O(points).
[[nodiscard]] ComparedPoints count_compared(const ClSurface& surface, const Signals& signals, const PointRange& points);

/// Pointers to some candidates, in the order of their points. Candidates are not copied: each has 150 bytes, and a bad part has
/// a million.
using DefectCandidates = std::vector<const DefectCandidate*>;
using CandidateSpan = std::span<const DefectCandidate* const>;  ///< in the order of their points

/// Index of the first candidate that is not before a point. O(log candidates).
[[nodiscard]] std::size_t index_by_point(CandidateSpan candidates, PointIndex point);
/// The candidates less than `along` [mm] of arc length before or after a point. O(log candidates + candidates found).
[[nodiscard]] CandidateSpan candidates_near(CandidateSpan candidates, PointIndex point, const ArcLength& arc_length,
                                            double along);

/// All candidates of a part, with their storage.
struct FoundCandidates {
    std::vector<std::vector<DefectCandidate>> kept;
    DefectCandidates candidates;

    /// The candidates with a share of a quantity, in the order of their points.
    [[nodiscard]] std::vector<DefectCandidate*> with_share_of(Quantity quantity);
};

/// Sites (sites.h) whose residual exceeds half a threshold, in the order of their points. Only sites with a step are compared
/// with all surrounding passes, and then the sites next to each candidate, because the inner passes of a band have no step.
/// O(points), parallel; the same for any number of threads.
[[nodiscard]] FoundCandidates find_candidates(const ClSurface& surface, const Signals& signals,
                                              const ArcLength& arc_length, const Thresholds& thresholds);

/// First part of the search: the candidates among `points` that have a step, in order.
[[nodiscard]] std::vector<PointIndex> find_starts(const ClSurface& surface, const Signals& signals,
                                                  const ArcLength& arc_length, const Thresholds& thresholds,
                                                  const PointRange& points);
/// Second part: all candidates, found from the starts of all points. Only the points around the starts are read, in portions;
/// `forget` is called between them.
[[nodiscard]] FoundCandidates find_candidates(const ClSurface& surface, const Signals& signals,
                                              const ArcLength& arc_length, const Thresholds& thresholds,
                                              const std::vector<PointIndex>& starts, const ForgetBlocks& forget);

/// Largest arc length [mm] between candidates of one pass that belong together: 1 mm, two step-overs or two and a half records,
/// whichever is longest. `record`: length of a record at the usual speed.
[[nodiscard]] double joined_along(const ClSurface& surface, double record);

/// Groups of connected candidates: along a pass (`along`: joined_along()), to the adjacent pass, or across one clean pass. Each
/// group is in the order of its points, and groups are in the order of their first points. O(candidates log candidates),
/// parallel. `forget`: called between portions of the candidates.
[[nodiscard]] std::vector<DefectCandidates> group_candidates(const DefectCandidates& candidates,
                                                             const ClSurface& surface, const ArcLength& arc_length,
                                                             double along, const ForgetBlocks& forget = {});

}  // namespace clsurf
