#pragma once
// Completion for bash, zsh and fish, generated from the program's own tables.

#include <string>

namespace clsurf::cli {

[[nodiscard]] std::string bash_completion();
[[nodiscard]] std::string zsh_completion();
[[nodiscard]] std::string fish_completion();

}  // namespace clsurf::cli
