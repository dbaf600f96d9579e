#pragma once
// The core of a group of candidates: its strong sites, which make the defect.

#include <vector>

#include "predictor/candidates.h"

namespace clsurf {

// See docs/design/predictor.md#4-join-places-into-defects.
constexpr float half_of_peak = 0.5F;

/// Splits `sites` into sections along one pass whose sites are less than `joined` mm apart. O(sites).
[[nodiscard]] std::vector<CandidateSpan> runs_of(CandidateSpan sites, const ArcLength& arc_length, double joined);

struct CoreSites {
    DefectCandidates core;
    DefectCandidates rest;  ///< peaks much weaker than the strongest: another defect, joined by chance
};

/// On each pass, the sites of a group where `quantity` reaches half of its peak there. Dips shorter than `joined` mm are
/// included, because an oscillation crosses zero. If a longer dip separates two peaks of speed or acceleration on one pass,
/// each side counts from its own peak. Both lists are in the order of their points. O(sites · sites within `joined`²).
[[nodiscard]] CoreSites core_of(CandidateSpan group, Quantity quantity, const ArcLength& arc_length, double joined);

/// The length [mm] of the runs of a core, extended on both sides as far as `quantity` exceeds its threshold with the same sign.
/// The core alone would not do: the sharper a peak is, the shorter it is at half of its height. A run is not extended into a
/// higher peak. Counting stops once the sum reaches `enough`. `sites`: all candidates of the family. O(core log sites + sites
/// within `enough`).
[[nodiscard]] double length_above_threshold(CandidateSpan core, CandidateSpan sites, Quantity quantity,
                                            const ArcLength& arc_length, double joined, double enough);

}  // namespace clsurf
