#pragma once
// The core of a group of candidates: its strong sites, which make the defect.

#include <span>
#include <vector>

#include "predictor/candidates.h"

namespace clsurf {

/// Candidates in the order of their points.
using CandidateSpan = std::span<const DefectCandidate* const>;

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

/// How long [mm] the runs of a core are together with the sites beside them where `quantity` passes its threshold on the same
/// side: the sharper a peak is, the shorter it is at half of its height. They end where another peak rises higher, and the sum is
/// complete only up to `enough`. `sites`: all candidates of the family in the order of their points.
/// O(core log sites + sites within `enough`).
[[nodiscard]] double length_above_threshold(CandidateSpan core, CandidateSpan sites, Quantity quantity,
                                            const ArcLength& arc_length, double joined, double enough);

}  // namespace clsurf
