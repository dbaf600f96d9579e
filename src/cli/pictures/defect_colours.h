#pragma once
// How well a picture shows a defect.

#include <vector>

#include "pipeline/part.h"
#include "predictor/defect.h"

namespace clsurf::cli {

/// How different a defect and the adjacent passes look in the map that `render` draws by default: speeds as shares of the
/// programmed feed, or where there is none of the usual speed. CIEDE2000, one for each defect.
[[nodiscard]] std::vector<double> colour_differences(const QualityReport& report, const Part& part);

}  // namespace clsurf::cli
