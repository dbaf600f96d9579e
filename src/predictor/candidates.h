#pragma once
// Candidates: the sites of a surface that differ from their adjacent passes, and how they belong
// together.

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
    bool bend = false;     ///< a bend explains its motion (bend.h): that difference is expected
    std::array<float, quantities> share{};  ///< |residual| over threshold
    std::array<float, quantities> score{};  ///< the same, where the step passes it too; from 1 on a defect starts
    Comparison comparison;

    [[nodiscard]] bool bends(Quantity q) const { return bend && (q == Quantity::speed || q == Quantity::acceleration); }
    /// What it shows of a quantity is expected there.
    [[nodiscard]] bool expected(Quantity q) const { return border || bends(q); }
};

/// Those among `points` that can be judged. O(points).
[[nodiscard]] ComparedPoints count_compared(const ClSurface& surface, const Signals& signals, const PointRange& points);

/// Some candidates, in the order of their points. They stay where they were found: each is 150 bytes, and
/// a bad part has a million.
using DefectCandidates = std::vector<const DefectCandidate*>;
using CandidateSpan = std::span<const DefectCandidate* const>;  ///< in the order of their points

/// Index of the first candidate that is not before a point. O(log candidates).
[[nodiscard]] std::size_t index_by_point(CandidateSpan candidates, PointIndex point);
/// Those less than `along` [mm] of arc length before or behind a point.
/// O(log candidates + those found).
[[nodiscard]] CandidateSpan candidates_near(CandidateSpan candidates, PointIndex point, const ArcLength& arc_length,
                                            double along);

/// All candidates of a part, and where they are kept.
struct FoundCandidates {
    std::vector<std::vector<DefectCandidate>> kept;
    DefectCandidates candidates;

    /// Those with a share of a quantity, in the order of their points.
    [[nodiscard]] std::vector<DefectCandidate*> with_share_of(Quantity quantity);
};

/// Sites (sites.h) whose residual passes half a threshold, in the order of their points. Only sites with a step are
/// looked at with all passes around, and then what lies beside a candidate: the inner passes of a band
/// have no step of their own. O(points), parallel; the same for any number of threads.
[[nodiscard]] FoundCandidates find_candidates(const ClSurface& surface, const Signals& signals,
                                              const ArcLength& arc_length, const Thresholds& thresholds);

/// The search in two parts: the candidates among `points` that have a step, in order …
[[nodiscard]] std::vector<PointIndex> find_starts(const ClSurface& surface, const Signals& signals,
                                                  const ArcLength& arc_length, const Thresholds& thresholds,
                                                  const PointRange& points);
/// … and all candidates, from those of all points. Only what lies about them is looked at, in portions between which
/// `forget` is called.
[[nodiscard]] FoundCandidates find_candidates(const ClSurface& surface, const Signals& signals,
                                              const ArcLength& arc_length, const Thresholds& thresholds,
                                              const std::vector<PointIndex>& starts, const ForgetBlocks& forget);

/// How much arc length [mm] may lie between candidates of one pass that belong together: a millimetre, two step-overs or two records, with room.
/// `record`: the length of one at the usual speed.
[[nodiscard]] double joined_along(const ClSurface& surface, double record);

/// Candidates that hang together along a pass (`along`: joined_along()), across to the next one or over one clean pass; each group
/// in the order of its points, and groups in the order of their first ones. O(candidates log candidates), parallel.
/// `forget`: called between portions of the candidates.
[[nodiscard]] std::vector<DefectCandidates> group_candidates(const DefectCandidates& candidates,
                                                             const ClSurface& surface, const ArcLength& arc_length,
                                                             double along, const ForgetBlocks& forget = {});

}  // namespace clsurf
