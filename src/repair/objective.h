#pragma once
// The objective of a repair, in one place: mismatch, defects and time of a run, the roughness of the resulting surface, and the
// length of the program.

#include <algorithm>
#include <string>
#include <string_view>

#include "core/not_finite.h"
#include "machined/part_roughness.h"

namespace clsurf {

/// The measures of a run of a program. Lower is better for each but `speed`, to which the others are compared.
struct RunMeasures {
    double mismatch = 0;                 ///< [mm/s] 95th percentile of the speed differences between adjacent passes
    double defects = 0;                  ///< their number, as in `check`; may be fractional in a mean
    double duration = 0;                 ///< [s]
    double speed = 0;                    ///< [mm/s] usual speed of the cuts
    double roughness = missing<double>;  ///< [mm] Ra of the as-machined surface; NaN: not known
    double defect_mismatch = 0;          ///< [mm/s] the largest speed difference of a defect
};

/// The measures of a run with its roughness, if that is known.
[[nodiscard]] RunMeasures with_roughness(RunMeasures measures, const PartRoughness& roughness);

/// Relative rise of the roughness that is not significant, because it is measured at some places only (docs/optimize.md#method,
/// step 8).
inline constexpr double roughness_agrees = 0.01;

/// Mismatch, as a share of the speed, below which it counts as zero (docs/optimize.md#the-objective).
inline constexpr double least_mismatch = 0.002;

/// Whether RunMeasures::mismatch of the run before counts as zero. A few sections may still differ; then defect_mismatch
/// counts.
[[nodiscard]] inline bool defects_alone_count(const RunMeasures& before) {
    return before.mismatch <= least_mismatch * before.speed;
}

/// The mismatch of `run` that counts [mm/s].
[[nodiscard]] inline double objective_mismatch(const RunMeasures& before, const RunMeasures& run) {
    return defects_alone_count(before) ? std::max(run.mismatch, run.defect_mismatch) : run.mismatch;
}

/// Smaller gains are not worth a new program (docs/optimize.md#the-objective).
inline constexpr double least_gain = 0.02;

/// The objective, relative to the run before: m + d + t + r + 0.03 g. m is the remaining share of objective_mismatch(), both
/// at least least_mismatch; the part of m below one half has a weight of one tenth, because defects matter more from there on.
/// d is the remaining share of the defects. t is the share of additional time, at most `more_time`. r is the remaining share of
/// the roughness, if both are known. g = lines after / lines before.
[[nodiscard]] double objective(const RunMeasures& before, const RunMeasures& after, double line_ratio,
                               double more_time);

/// The share by which the objective is lower than for the unchanged program; negative: it is higher.
[[nodiscard]] double gain_of(const RunMeasures& before, const RunMeasures& after, double line_ratio, double more_time);

/// "`what` is 1.3 %, less than 2 %"; empty: it is at least least_gain.
[[nodiscard]] std::string too_little_gain(std::string_view what, double gain);

/// Why `after` is not better than `before` in every respect: mismatch, defects, time (with `more_time`, a share), roughness;
/// empty: it is.
[[nodiscard]] std::string why_not_better(const RunMeasures& before, const RunMeasures& after, double more_time);

}  // namespace clsurf
