#pragma once
// The data of a page: a manifest in JSON that names packed columns, and the columns. Used inside io only;
// viz/page/src/manifest.ts has the same names.

#include <string>
#include <vector>

#include "io/files/json_value.h"
#include "io/page/page_content.h"
#include "io/page/page_pack.h"

namespace clsurf::io {

struct PageData {
    Json manifest;
    std::vector<std::string> blocks;  ///< base64, by number; the columns refer to them
};

[[nodiscard]] PageData page_data(const ReportPage& page);

}  // namespace clsurf::io
