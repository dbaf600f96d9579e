#pragma once
// Which of the predicted marks a measurement shows. Both depths are determined in the same way (mark_depth()), across the
// passes, at the place where the measurement crosses the mark.

#include <cstdint>
#include <string>
#include <vector>

#include "measured/compare_measured.h"
#include "predictor/defect.h"

namespace clsurf {

enum class MarkState : std::uint8_t {
    found,
    missing,     ///< less than half of the predicted depth or height
    not_judged,  ///< `reason` states why
};

struct ComparedMark {
    std::size_t defect = 0;  ///< index in the report
    MarkState state = MarkState::not_judged;
    Vec3 place = Vec3::Zero();           ///< [mm] where the measurement crosses it
    double along = 0;                    ///< [mm] from the first place of a profile
    bool pit = false;                    ///< predicted below its neighbours; else above them
    double predicted = 0, measured = 0;  ///< [mm] depths there, or heights of a bulge
    std::string reason;
};

/// The marks that the measurement crosses, in the order of `report`. `noise` [mm]: as in MeasuredComparison; marks of less
/// than three times the noise are not judged.
[[nodiscard]] std::vector<ComparedMark> compare_marks(const MeasuredData& data, const AlignedHeights& measured,
                                                      const AsMachinedSurface& as_machined, const Signals& signals,
                                                      const QualityReport& report, double noise);

}  // namespace clsurf
