#pragma once
// The core of a group of candidates: its strong sites, which make the defect.

#include <vector>

#include "predictor/candidates.h"

namespace clsurf {

constexpr float half_of_peak = 0.5F;

/// The sections of `sites` that each hang together along one pass: less than `joined` mm lie between them. O(sites).
[[nodiscard]] std::vector<CandidateSpan> runs_of(CandidateSpan sites, const ArcLength& arc_length, double joined);

struct CoreSites {
    DefectCandidates core;
    DefectCandidates rest;  ///< peaks much weaker than the strongest: something else, joined with it by chance
};

/// On each pass, the sites of a group where `quantity` reaches half of its peak there. Dips shorter than `joined` mm
/// belong to them, as an oscillation crosses zero. Where a longer dip lies between two peaks of a speed or an
/// acceleration on one pass, each counts from its own peak. Both lists in the order of their points. O(sites · sites within `joined`²).
[[nodiscard]] CoreSites core_of(CandidateSpan group, Quantity quantity, const ArcLength& arc_length, double joined);

/// The length [mm] of the runs of a core, extended on both sides as far as `quantity` exceeds its threshold with the same sign: the
/// sharper a peak is, the shorter it is at half of its height. A run is not extended into a higher peak. Counting stops once the
/// sum reaches `enough`. `sites`: all candidates of the family.
/// O(core log sites + sites within `enough`).
[[nodiscard]] double length_above_threshold(CandidateSpan core, CandidateSpan sites, Quantity quantity,
                                            const ArcLength& arc_length, double joined, double enough);

}  // namespace clsurf
