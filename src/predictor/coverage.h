#pragma once
// Coverage: whether enough of a part could be compared for a verdict.

#include "predictor/defect.h"

namespace clsurf {

/// Refuses a verdict in `report` if too little could be compared, and gives the reason. `record` [mm]: the length of one record
/// at the usual speed.
void judge_coverage(double record, QualityReport& report);

}  // namespace clsurf
