#pragma once
// Comparison of an aligned measurement with the as-machined surface: the same places, the same form taken off, the same
// filters, and so Ra, Rq and Rz of both.

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
    std::vector<double> along;                ///< [mm] arc length of the form, of filters and sampling lengths
    std::size_t first = 0, count = 0;         ///< the longest section in which both are known …
    std::vector<double> measured_rough, predicted_rough;  ///< … and its roughness profiles [mm]
    Roughness of_measured, of_predicted;
    double correlation = 0;  ///< of the roughness profiles over the evaluation length, −1 … 1
};

struct MeasuredComparison {
    std::vector<ComparedProfile> profiles;  ///< one of a profile; of a map up to eleven across the feed
    Roughness measured, predicted;          ///< means over the profiles; length 0: nothing could be compared
    double correlation = 0;                 ///< mean
    double noise = 0;                       ///< [mm] standard deviation of measured less predicted roughness, robust
    double short_cutoff = 0;                ///< [mm] λs; 0: the places lie too far apart for it
    std::string reason;                     ///< why nothing was compared; empty: it was
};

/// Short waves that are taken off before a roughness is measured: λs of ISO 3274 that belongs to a cut-off λc [mm].
[[nodiscard]] double short_cutoff_for(double cutoff);

/// The deviations of both along a row; `of` and `tolerance` as of Form.
[[nodiscard]] ComparedProfile deviations_of_both(const AlignedHeights& measured, const AsMachinedSurface& as_machined,
                                                 const ProfileRow& row, Form::Of of = Form::Of::program,
                                                 double tolerance = 0);

/// Points are too few for a profile: they are aligned only. Parallel.
[[nodiscard]] MeasuredComparison compare_roughness(const MeasuredData& data, const AlignedHeights& measured,
                                                   const AsMachinedSurface& as_machined, const Signals& signals);

}  // namespace clsurf
