#pragma once
// The parts of a page that need no JavaScript. Used inside io only.

#include <string>

#include "io/page/page_content.h"

namespace clsurf::io {

/// "part.nc · run.biip".
[[nodiscard]] std::string page_title(const ReportPage& page);
/// What a reader wants to know first.
[[nodiscard]] std::string page_summary(const ReportPage& page);
/// Pictures, defects, mismatch, roughness, log health, and what the page leaves out.
[[nodiscard]] std::string page_sections(const ReportPage& page);

}  // namespace clsurf::io
