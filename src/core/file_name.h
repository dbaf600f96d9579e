#pragma once

#include <cstddef>
#include <string>

namespace clsurf {

/// What stands behind the last slash of a path: how titles and messages name a file.
[[nodiscard]] inline std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// The folder that a path names a file in, with its slash; "." where it names none.
[[nodiscard]] inline std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string(".") : path.substr(0, slash + 1);
}

}  // namespace clsurf
