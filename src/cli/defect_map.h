#pragma once
// What the defect map of `render --defects` shows of a report.

#include "predictor/defect.h"
#include "viz/defect_map.h"

namespace clsurf::cli {

/// The defects of a report as marks, the strongest first.
[[nodiscard]] viz::DefectMap defect_map_of(const QualityReport& report);

}  // namespace clsurf::cli
