#pragma once
// Comparison of an aligned measurement with the as-machined surface: Ra, Rq and Rz of both, at the same places, with the same
// form subtracted and the same filters.

#include <vector>

#include "machined/across_feed.h"
#include "machined/roughness.h"
#include "measured/align.h"
#include "measured/aligned_heights.h"

namespace clsurf {

/// A profile of both.
struct ComparedProfile {
    ProfileRow row;
    std::vector<double> measured, predicted;  ///< [mm] deviations from the form along its normal; NaN: not known
    std::vector<double> along;                ///< [mm] arc length of the form, for filters and sampling lengths
    std::size_t first = 0, count = 0;         ///< the longest section in which both are known …
    std::vector<double> measured_rough, predicted_rough;  ///< … and its roughness profiles [mm]
    Roughness of_measured, of_predicted;
    double correlation = 0;  ///< of the roughness profiles over the evaluation length, −1 … 1
};

struct MeasuredComparison {
    std::vector<ComparedProfile> profiles;  ///< one for a profile; for a map up to eleven across the feed
    Roughness measured, predicted;          ///< means over the profiles; length 0: nothing could be compared
    double correlation = 0;                 ///< mean
    double noise = 0;                       ///< [mm] standard deviation of measured minus predicted roughness, robust
    double short_cutoff = 0;                ///< [mm] λs; 0: the places are too far apart for it
    std::string reason;                     ///< why nothing was compared; empty: it was
};

/// The cut-off λs below which waves are removed before a roughness is measured: the value in ISO 3274 for a cut-off λc [mm].
[[nodiscard]] double short_cutoff_for(double cutoff);

/// The deviations of both along a row; `of` and `tolerance` as for Form.
[[nodiscard]] ComparedProfile deviations_of_both(const AlignedHeights& measured, const AsMachinedSurface& as_machined,
                                                 const ProfileRow& row, Form::Of of = Form::Of::program,
                                                 double tolerance = 0);

/// Single points have no profile: they are only aligned. Parallel.
[[nodiscard]] MeasuredComparison compare_roughness(const MeasuredData& data, const AlignedHeights& measured,
                                                   const AsMachinedSurface& as_machined, const Signals& signals);

}  // namespace clsurf
