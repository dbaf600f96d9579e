#pragma once
// The pages of docs/reference.

#include <vector>

#include "cli/manual/manual_file.h"

namespace clsurf::cli {

/// README.md, one page per subcommand and one per vocabulary.
[[nodiscard]] std::vector<ManualFile> reference_pages();

}  // namespace clsurf::cli
