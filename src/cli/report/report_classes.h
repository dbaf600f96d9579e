#pragma once
// Fields of a page whose values are names: which classes they have, in the colours of `render`.

#include <vector>

#include "cli/report/report_log.h"

namespace clsurf::cli {

/// The classes of each field of each log. A class has the same colour in all logs: that of the first one.
void name_classes(std::vector<ReportLog>& logs);

}  // namespace clsurf::cli
