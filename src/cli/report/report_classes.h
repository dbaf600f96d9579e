#pragma once
// Fields of a page whose values are names: their classes, with the colours of `render`.

#include <vector>

#include "cli/report/report_log.h"

namespace clsurf::cli {

/// Sets the classes of each field of each log. A class has the same colour in all logs: its colour in the first log.
void name_classes(std::vector<ReportLog>& logs);

}  // namespace clsurf::cli
