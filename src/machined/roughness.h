#pragma once
// Roughness of profiles (ISO 4287, Gaussian filter of ISO 16610-21) and of areas (ISO 25178-2). Lengths
// and heights in one unit throughout, mm here.

#include <span>
#include <string>
#include <vector>

namespace clsurf {

/// Heights of an unfiltered profile about its mean. Rz is the height from lowest to highest.
struct ProfileHeights {
    double ra = 0, rq = 0, rz = 0;
};
/// O(points). Nothing to measure (no points): zeros.
[[nodiscard]] ProfileHeights profile_heights(std::span<const double> z);

/// The waviness: the mean line of a Gaussian filter that halves waves of length `cutoff`. At the ends, the weights of the
/// existing values are scaled up. Domain: step, cutoff > 0. O(points · cutoff / step).
[[nodiscard]] std::vector<double> gaussian_mean_line(std::span<const double> z, double step, double cutoff);

/// The same for values at increasing distances `along` a line [mm]; they are resampled in equal steps.
[[nodiscard]] std::vector<double> gaussian_mean_line(std::span<const double> z, std::span<const double> along,
                                                     double cutoff);

/// The cut-off [mm] for scallops at a given spacing: 0.8 mm, or for wider spacings the cut-off that ISO 4288 (now ISO 21920-3)
/// gives for profile elements of that width: 2.5 mm above 0.4 mm, 8 mm above 1.3 mm. A step-over up to 2 % above such a limit
/// counts as the limit: it is estimated from logged positions, and runs of one program must not get different cut-offs.
[[nodiscard]] double cutoff_for(double step_over);
/// A cut-off in words, with the step-overs for which it is used.
[[nodiscard]] std::string cutoff_text(double cutoff);

/// Roughness of a profile: the residual of the filter, in the middle of the profile.
struct Roughness {
    double ra = 0, rq = 0;
    double rz = 0;      ///< mean over the sampling lengths of the height from lowest to highest
    double length = 0;  ///< evaluated length; 0: nothing was evaluated
    int sampling_lengths = 0;
    double cutoff = 0;
};

/// Evaluates up to five sampling lengths of one cut-off each, in the middle. Half a cut-off is excluded at both ends, where the
/// filter has too few values. A profile shorter than two cut-offs is one sampling length. Domain: z finite.
[[nodiscard]] Roughness roughness_of(std::span<const double> z, double step, double cutoff);
/// The same for values at increasing distances `along` a line [mm], which on an incline are longer than seen from above.
[[nodiscard]] Roughness roughness_of(std::span<const double> z, std::span<const double> along, double cutoff);

/// Of an area about its mean; NaN: no value. Sz is the height from lowest to highest.
struct AreaHeights {
    double sa = 0, sq = 0, sz = 0;
    std::size_t cells = 0;  ///< number of cells with a value
};
/// `weights`, 0 … 1, one for each value; empty: all are 1. Sz counts values with a weight of at least a half. O(cells).
[[nodiscard]] AreaHeights area_heights(std::span<const float> z, std::span<const float> weights = {});

}  // namespace clsurf
