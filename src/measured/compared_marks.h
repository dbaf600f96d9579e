#pragma once
// Which of the predicted marks a measurement shows. Both depths are measured alike (mark_depth()), across the passes, at the
// place where the measurement crosses the mark.

#include <cstdint>
#include <string>
#include <vector>

#include "measured/compare_measured.h"
#include "predictor/defect.h"

namespace clsurf {

enum class MarkState : std::uint8_t {
    found,
    missing,     ///< less than half as deep, or as high, as predicted
    not_judged,  ///< `reason` says why
};

struct ComparedMark {
    std::size_t defect = 0;  ///< its index in the report
    MarkState state = MarkState::not_judged;
    Vec3 place = Vec3::Zero();           ///< [mm] where the measurement crosses it
    double along = 0;                    ///< [mm] from the first place of a profile
    bool pit = false;                    ///< it is predicted below its neighbours; else above them
    double predicted = 0, measured = 0;  ///< [mm] depths there, of a bulge heights
    std::string reason;
};

/// The marks that the measurement crosses, in the order of `report`; marks elsewhere are left out. `noise` [mm] of
/// MeasuredComparison: marks of less than three times that are not judged.
[[nodiscard]] std::vector<ComparedMark> compare_marks(const MeasuredData& data, const AlignedHeights& measured,
                                                      const AsMachinedSurface& as_machined, const Signals& signals,
                                                      const QualityReport& report, double noise);

}  // namespace clsurf
