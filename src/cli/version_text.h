#pragma once
// The output of `clsurf --version`.

#include <string>

namespace clsurf::cli {

/// The commit of the sources: twelve hexadecimal digits, followed by "-dirty" if the tree had
/// changes; "unknown" if the sources came without git and not from `git archive`. Defined by
/// src/cli/write_commit.cmake.
[[nodiscard]] const char* source_commit();

/// Version, commit, compiler and libraries, one line each. The renderer name comes from OSMesa itself; without OSMesa the
/// line says why.
[[nodiscard]] std::string version_text();

}  // namespace clsurf::cli
