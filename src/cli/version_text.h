#pragma once
// What `clsurf --version` prints.

#include <string>

namespace clsurf::cli {

/// The commit that the program was built from: twelve hexadecimal digits, "-dirty" behind them where the tree had
/// changes; "unknown" where the sources came without git and not from `git archive`. Defined by
/// src/cli/write_commit.cmake.
[[nodiscard]] const char* source_commit();

/// Version, commit, compiler and libraries, a line each. The renderer is asked from OSMesa itself; without one, the
/// line says why.
[[nodiscard]] std::string version_text();

}  // namespace clsurf::cli
