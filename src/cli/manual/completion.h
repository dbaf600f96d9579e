#pragma once
// Completion for bash, zsh and fish, written from the tables that the program itself uses.

#include <string>

namespace clsurf::cli {

[[nodiscard]] std::string bash_completion();
[[nodiscard]] std::string zsh_completion();
[[nodiscard]] std::string fish_completion();

}  // namespace clsurf::cli
