#pragma once
// The man pages, in troff.

#include <vector>

#include "cli/manual/manual_file.h"

namespace clsurf::cli {

/// clsurf.1, and one page per subcommand.
[[nodiscard]] std::vector<ManualFile> man_pages();

}  // namespace clsurf::cli
