#pragma once
// How visible a defect is in a picture.

#include <vector>

#include "pipeline/part.h"
#include "predictor/defect.h"

namespace clsurf::cli {

/// The colour difference of a defect and the adjacent passes in the map that `render` draws by default: speeds as shares of
/// the programmed feed, or if there is none, of the usual speed. CIEDE2000, one for each defect.
[[nodiscard]] std::vector<double> colour_differences(const QualityReport& report, const Part& part);

}  // namespace clsurf::cli
