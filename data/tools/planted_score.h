#pragma once
// The score of a predictor on planted logs: how many defects it finds, how many it invents, and the errors
// of places, lines and depths.

#include "planted_log.h"
#include "predictor/defects.h"
#include "program/program.h"

namespace clsurf::planted {

/// Its program, read.
[[nodiscard]] Program program_of(const PlantedLog& planted);

/// The report of the project's own pipeline for a log.
[[nodiscard]] QualityReport judge(const PlantedLog& planted, const QualityRules& rules = {});

struct Score {
    int planted = 0;   ///< defects
    int found = 0;     ///< defects with a flagged point within 0.2 mm of 30 % of their points
    int reported = 0;  ///< regions
    int right = 0;     ///< regions with 30 % of their points within 0.8 mm of a planted one
    int natural =
        0;  ///< other regions whose plan differs from the nearest pass by 5 % of the speed or more at a quarter of the points
    PointIndex points = 0;
    std::vector<double> depth_errors;  ///< relative depth errors of the lag defects found
    int placed = 0;                    ///< defects found with the position within a step-over of a planted point
    int lined = 0;                     ///< defects found with the planted lines inside the reported ones, ±1
    int named = 0;                     ///< defects found with their cause
    int signed_right = 0;  ///< defects found with the right sign (slower, faster, above, below); swings have either

    Score& operator+=(const Score& other);
    [[nodiscard]] double recall() const { return planted > 0 ? static_cast<double>(found) / planted : 1.0; }
    /// The share of right regions among those that are not differences of the plan.
    [[nodiscard]] double precision() const {
        const int judged = reported - natural;
        return judged > 0 ? static_cast<double>(right) / judged : 1.0;
    }
};

[[nodiscard]] Score score(const PlantedLog& planted, const QualityReport& report);

}  // namespace clsurf::planted
