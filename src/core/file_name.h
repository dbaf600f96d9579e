#pragma once

#include <cstddef>
#include <string>

namespace clsurf {

/// The part of a path after the last slash: the name of a file in titles and messages.
[[nodiscard]] inline std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// The folder part of a path, with its slash; "." if the path names no folder.
[[nodiscard]] inline std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string(".") : path.substr(0, slash + 1);
}

}  // namespace clsurf
