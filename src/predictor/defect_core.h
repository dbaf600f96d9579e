#pragma once
// The core of a group of candidates: its strong sites, which make the defect.

#include <span>

#include "predictor/candidates.h"

namespace clsurf {

/// Candidates in the order of their points.
using CandidateSpan = std::span<const DefectCandidate* const>;

constexpr float half_of_peak = 0.5F;

/// f(run) for the sections of `sites` that each hang together along one pass: less than `joined` mm lie between them.
template <typename F>
void for_each_run(CandidateSpan sites, const ArcLength& arc_length, double joined, F&& f) {
    for (std::size_t k = 0; k < sites.size();) {
        std::size_t end = k + 1;
        while (end < sites.size() && sites[end]->pass == sites[k]->pass &&
               !arc_length.at_least(sites[end - 1]->point, sites[end]->point, joined))
            ++end;
        f(sites.subspan(k, end - k));
        k = end;
    }
}

struct CoreSites {
    DefectCandidates core;
    DefectCandidates rest;  ///< peaks much weaker than the strongest: something else, joined with it by chance
};

/// On each pass, the sites of a group where `quantity` reaches half of its peak there. Dips shorter than `joined` mm
/// belong to them, as an oscillation crosses zero. Where a longer dip lies between two peaks of a speed or an
/// acceleration on one pass, each counts from its own peak. Both lists in the order of their points. O(sites · sites within `joined`²).
[[nodiscard]] CoreSites core_of(CandidateSpan group, Quantity quantity, const ArcLength& arc_length, double joined);

}  // namespace clsurf
