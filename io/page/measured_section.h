#pragma once
// The section of a page that compares a measurement of the part with the prediction. Used inside io only.

#include <string>

#include "io/page/page_content.h"

namespace clsurf::io {

/// Empty: nothing was measured.
[[nodiscard]] std::string measured_section(const ReportPage& page);

}  // namespace clsurf::io
