#pragma once
// DefectProfile: speed and height of a pass at fault and of the passes beside it, over the same path: the numbers that prove
// a mark.

#include <array>
#include <vector>

#include "mapping/line_map.h"
#include "predictor/defect.h"

namespace clsurf {

struct DefectProfile {
    /// The pass at fault and two on each side, from left to right in its direction of travel.
    static constexpr int aside = 2;
    static constexpr std::size_t passes = 2 * aside + 1;
    static constexpr std::size_t at_fault = aside;  ///< index

    std::vector<double>
        along;  ///< [mm] along the pass at fault; 0 where its section begins, which has room on both sides
    double section_length = 0;                      ///< [mm]
    std::array<std::vector<float>, passes> speed;   ///< [mm/s] of each pass, one value per place; NaN: no pass there
    std::array<std::vector<float>, passes> height;  ///< [mm] lag where it was measured, else relief, along the normal
    std::vector<float> usual_speed, usual_height;   ///< the median of the other passes at each place; NaN: none
    struct LineStart {
        double along = 0;  ///< [mm]
        LineNumber line = 0;
    };
    std::vector<LineStart> lines;  ///< where each line of the pass at fault begins

    std::vector<double> across;        ///< [mm] to the left (−) and right of the strongest place, pass by pass
    std::vector<float> across_height;  ///< [mm] there
    bool lag = false;                  ///< heights are lags of measured positions
};

/// Of the section that is strongest. O(points of the section).
[[nodiscard]] DefectProfile profile_of(const Defect& defect, const ClSurface& surface, const Signals& signals,
                                       const LineMap& lines);

}  // namespace clsurf
