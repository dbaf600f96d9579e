#pragma once

#include <string>

namespace clsurf::cli {

/// One file that `clsurf manual` writes.
struct ManualFile {
    std::string name;  ///< in the output folder
    std::string text;
};

}  // namespace clsurf::cli
