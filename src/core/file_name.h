#pragma once

#include <string>

namespace clsurf {

/// What stands behind the last slash of a path: how titles and messages name a file.
[[nodiscard]] inline std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace clsurf
