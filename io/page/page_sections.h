#pragma once
// The sections of a page that need no JavaScript. Used inside io only.

#include <string>

#include "io/page/page_content.h"

namespace clsurf::io {

/// "part.nc · run.biip".
[[nodiscard]] std::string page_title(const ReportPage& page);
/// The summary at the top of the page.
[[nodiscard]] std::string page_summary(const ReportPage& page);
/// Pictures, defects, mismatch, roughness, log health, and what the page omits.
[[nodiscard]] std::string page_sections(const ReportPage& page);

}  // namespace clsurf::io
