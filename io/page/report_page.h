#pragma once
// The page that `clsurf report` writes: one HTML file that requests nothing from a server. Summary, pictures,
// tables and log health are plain HTML. The part follows as packed columns (page_pack.h), from which the script of
// the page (viz/page) draws the view.

#include <string>

#include "io/page/page_content.h"

namespace clsurf::io {

/// The whole document. O(kept points) in time and memory.
[[nodiscard]] std::string write_page(const ReportPage& page);

}  // namespace clsurf::io
