#pragma once
// The pages of docs/reference.

#include <vector>

#include "cli/manual/manual_file.h"

namespace clsurf::cli {

/// README.md, one page a subcommand and one a list of words that options take.
[[nodiscard]] std::vector<ManualFile> reference_pages();

}  // namespace clsurf::cli
