#pragma once
// DefectProfile: speed and height of a pass at fault and of the passes beside it, over the same path: the numbers that prove
// a mark.

#include <array>
#include <cstdint>
#include <vector>

#include "mapping/line_map.h"
#include "predictor/defect.h"
#include "predictor/programmed_marks.h"

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
    std::array<std::vector<float>, passes> height;  ///< [mm] along the normal, over what `height_of` says
    std::vector<float> usual_speed, usual_height;   ///< of the other passes at each place; NaN: none
    struct LineStart {
        double along = 0;  ///< [mm]
        LineNumber line = 0;
    };
    std::vector<LineStart> lines;  ///< where each line of the pass at fault begins

    std::vector<double> across;        ///< [mm] to the left (−) and right of the strongest place, pass by pass
    std::vector<float> across_height;  ///< [mm] there
    float usual_across = 0;            ///< [mm] what `usual_height` is at the strongest place; NaN: not known
    /// Where a mark is programmed, the passes that it is not on say how high the program should be there.
    enum class HeightOf : std::uint8_t {
        measured,    ///< measured positions over the programmed ones, and these over the clean passes
        programmed,  ///< programmed positions over the clean passes; of a relief, and without measured positions
        relief,      ///< over the chord between both adjacent passes; of neither of these
    };
    HeightOf height_of = HeightOf::relief;
};

/// Which passes say what height is usual.
enum class HeightPeers : std::uint8_t {
    nearest,  ///< two on each side
    same_direction,  ///< of four on each side, those that run as the pass at fault: where the lag alternates (systematic_lag.h)
};
[[nodiscard]] HeightPeers height_peers_of(const Defect& defect, const QualityReport& report);

/// Of the section that is strongest. `marks`: of the report that has the defect. What is usual is a median. O(points of the
/// section).
[[nodiscard]] DefectProfile profile_of(const Defect& defect, const ClSurface& surface, const Signals& signals,
                                       const LineMap& lines, const ProgrammedMarks& marks,
                                       HeightPeers peers = HeightPeers::nearest);

}  // namespace clsurf
