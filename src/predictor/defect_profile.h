#pragma once
// DefectProfile: speed and height of the causing pass and of the adjacent passes, over the same path. These numbers are the
// evidence for a mark.

#include <array>
#include <cstdint>
#include <vector>

#include "mapping/line_map.h"
#include "predictor/defect.h"
#include "predictor/programmed_marks.h"

namespace clsurf {

struct DefectProfile {
    /// The causing pass and two on each side, from left to right in its direction of travel.
    static constexpr int aside = 2;
    static constexpr std::size_t passes = 2 * aside + 1;
    static constexpr std::size_t at_fault = aside;  ///< index

    std::vector<double>
        along;  ///< [mm] along the causing pass; 0 where its section begins, with a margin on both sides
    double section_length = 0;                      ///< [mm]
    std::array<std::vector<float>, passes> speed;   ///< [mm/s] of each pass, one value per place; NaN: no pass there
    std::array<std::vector<float>, passes> height;  ///< [mm] along the normal, measured from what `height_of` states
    std::vector<float> usual_speed, usual_height;   ///< median of the other passes at each place; NaN: none
    struct LineStart {
        double along = 0;  ///< [mm]
        LineNumber line = 0;
    };
    std::vector<LineStart> lines;  ///< start of each line of the causing pass

    std::vector<double> across;        ///< [mm] to the left (−) and right of the strongest place, pass by pass
    std::vector<float> across_height;  ///< [mm] at these places
    float usual_across = 0;            ///< [mm] what `usual_height` is at the strongest place; NaN: not known
    /// What heights are measured from. For a programmed mark, clean passes give the height that the program should have there.
    enum class HeightOf : std::uint8_t {
        measured,    ///< measured positions above the programmed ones, plus those above the clean passes
        programmed,  ///< programmed positions above the clean passes; for a relief, or without measured positions
        relief,      ///< above the chord between both adjacent passes; if there is also no programmed mark
    };
    HeightOf height_of = HeightOf::relief;
};

/// The passes that define the usual height.
enum class HeightPeers : std::uint8_t {
    nearest,         ///< two on each side
    same_direction,  ///< of four on each side, those with the same direction: if the lag alternates (systematic_lag.h)
};
[[nodiscard]] HeightPeers height_peers_of(const Defect& defect, const QualityReport& report);

/// The profile of the section where the defect is strongest. `marks`: those of the report with this defect. Usual values are
/// medians. O(points of the section).
[[nodiscard]] DefectProfile profile_of(const Defect& defect, const ClSurface& surface, const Signals& signals,
                                       const LineMap& lines, const ProgrammedMarks& marks,
                                       HeightPeers peers = HeightPeers::nearest);

}  // namespace clsurf
